// SPDX-License-Identifier: BSD-3-Clause
#include "app/ini.hpp"

#include "core/quoted.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cctype>
#include <map>

namespace trime::app {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\f\v";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The line without its comment: `;` or `#` at the start or after a blank, so that a value may hold either.
std::string_view without_comment(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at)
    if ((text[at] == ';' || text[at] == '#') && (at == 0 || text[at - 1] == ' ' || text[at - 1] == '\t'))
      return text.substr(0, at);
  return text;
}

bool is_name(std::string_view text, bool dots) {
  if (text.empty() || text.front() == '.' || text.back() == '.')
    return false;
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || (dots && c == '.');
  });
}

/// State of one pass over the lines.
class Reader {
public:
  Reader(IniDocument& document, Diagnostics& problems) : document_(document), problems_(problems) {}

  void line(std::string_view text, int number) {
    text = trim(without_comment(text));
    if (text.empty())
      return;
    if (text.front() == '[')
      section(trim(text.substr(0, text.find_first_of(";#"))), number); // no name of a section holds them
    else
      entry(text, number);
  }

private:
  void section(std::string_view text, int number) {
    const std::string_view name = text.back() == ']' ? trim(text.substr(1, text.size() - 2)) : std::string_view{};
    in_section_ = is_name(name, true);
    if (!in_section_) {
      problems_.add(number, fmt::format("expected a section such as [domain], found {}", trime::quoted(text)));
      skip_ = true; // its keys would only be reported as misplaced
      return;
    }
    skip_ = false;
    std::vector<int>& lines = opened_[std::string(name)];
    for (const int line : lines)
      problems_.add(number, fmt::format("the section [{}] occurs twice, first on line {}; put its keys together",
                                        shown(name), line));
    if (lines.size() < most_told)
      lines.push_back(number);
    document_.sections.push_back({std::string(name), number});
  }

  void entry(std::string_view text, int number) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
      problems_.add(number, fmt::format("expected 'key = value' or '[section]', found {}", trime::quoted(text)));
      return;
    }
    const std::string_view key = trim(text.substr(0, equals)), value = trim(text.substr(equals + 1));
    if (!is_name(key, false)) {
      problems_.add(
          number, fmt::format("{} is not a valid name of a key: use letters, digits, '_' and '-'", trime::quoted(key)));
    } else if (skip_) {
      return;
    } else if (!in_section_) {
      problems_.add(number, fmt::format("the key {} comes before the first [section]", trime::quoted(key)));
    } else if (value.empty()) {
      problems_.add(number, fmt::format("the key {} has no value; write one, or remove the line", trime::quoted(key)));
    } else {
      store({document_.sections.back().name, std::string(key), std::string(value), number});
    }
  }

  void store(IniEntry entry) {
    const auto [first, is_first] = first_lines_.emplace(IniKey{entry.section, entry.key}, entry.line);
    if (is_first)
      document_.entries.push_back(std::move(entry));
    else
      problems_.add(entry.line, fmt::format("the key {} is set twice in [{}], first on line {}; keep one of them",
                                            trime::quoted(entry.key), shown(entry.section), first->second));
  }

  static constexpr std::size_t most_told = 30; // earlier places of one section: as many as Diagnostics::text shows

  IniDocument& document_;
  Diagnostics& problems_;
  std::map<IniKey, int> first_lines_;              // of keys
  std::map<std::string, std::vector<int>> opened_; // lines of each section
  bool in_section_ = false, skip_ = false;
};

} // namespace

std::string Diagnostics::place(int line) const {
  return line == command_line_origin ? "command line" : line == whole_file ? file_ : fmt::format("{}:{}", file_, line);
}

std::string Diagnostics::text(std::size_t limit) const {
  std::vector<Problem> sorted = problems_;
  const auto order = [](const Problem& p) { // lines, then the whole file, then the command line
    return std::pair(p.line > 0 ? 0 : p.line == whole_file ? 1 : 2, p.line);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Problem& a, const Problem& b) { return order(a) < order(b); });
  std::string result;
  for (std::size_t k = 0; k < std::min(limit, sorted.size()); ++k) {
    const auto& [line, message] = sorted[k];
    result += fmt::format("{}{}: {}", k == 0 ? "" : "\n", place(line), without_middle(message));
  }
  if (sorted.size() > limit)
    result += fmt::format("\n{}: {} more errors", file_, sorted.size() - limit);
  return result;
}

void Diagnostics::throw_if_any() const {
  if (!empty())
    throw ConfigError(text());
}

const IniEntry* IniDocument::find(std::string_view section, std::string_view key) const {
  for (const IniEntry& entry : entries)
    if (entry.section == section && entry.key == key)
      return &entry;
  return nullptr;
}

IniDocument parse_ini(std::string_view text, Diagnostics& problems) {
  IniDocument document;
  Reader reader(document, problems);
  if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
    text.remove_prefix(3);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.line(text.substr(0, end), number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return document;
}

void apply_override(IniDocument& document, std::string_view text, Diagnostics& problems) {
  const std::size_t equals = text.find('=');
  const std::string_view left = trim(text.substr(0, equals));
  const std::size_t dot = left.rfind('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos || !is_name(left.substr(0, dot), true) ||
      !is_name(left.substr(dot + 1), false)) {
    problems.add(command_line_origin, fmt::format("expected section.key=value, found {}", trime::quoted(text)));
    return;
  }
  const IniEntry entry{std::string(left.substr(0, dot)), std::string(left.substr(dot + 1)),
                       std::string(trim(text.substr(equals + 1))), command_line_origin};
  const IniEntry* known = document.find(entry.section, entry.key);
  if (known)
    document.entries.erase(document.entries.begin() + (known - document.entries.data()));
  const bool section_known = std::any_of(document.sections.begin(), document.sections.end(),
                                         [&](const IniSection& s) { return s.name == entry.section; });
  if (!section_known)
    document.sections.push_back({entry.section, command_line_origin});
  if (!entry.value.empty())
    document.entries.push_back(entry);
}

} // namespace trime::app
