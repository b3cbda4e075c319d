// SPDX-License-Identifier: BSD-3-Clause
#include "config_text.hpp"

#include "report.hpp"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace trime_check {
namespace {

constexpr const char* blanks = " \t\r\v\f";

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string without_comment(const std::string& line) {
  for (std::size_t k = 0; k < line.size(); ++k)
    if ((line[k] == ';' || line[k] == '#') && (k == 0 || std::isspace(static_cast<unsigned char>(line[k - 1]))))
      return trimmed(line.substr(0, k));
  return trimmed(line);
}

/// The numbers of a text, as many as there are; Fortran's 1D-3 is one.
std::vector<double> numbers_of(std::string text) {
  for (char& c : text)
    c = c == 'D' || c == 'd' ? 'e' : c == ',' || c == ';' ? ' ' : c;
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (char* end = nullptr;; at = end) {
    const double value = std::strtod(at, &end);
    if (end == at)
      return numbers;
    numbers.push_back(value);
  }
}

} // namespace

ConfigText::ConfigText(const std::string& text, std::string folder) : folder_(std::move(folder)) {
  std::istringstream lines(text);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    line = without_comment(line);
    if (line.size() > 2 && line.front() == '[' && line.back() == ']') {
      section = trimmed(line.substr(1, line.size() - 2));
      if (section.starts_with("shape."))
        parts_.push_back(section.substr(6));
    } else if (const std::size_t sign = line.find('='); sign != std::string::npos)
      values_[{section, trimmed(line.substr(0, sign))}] = trimmed(line.substr(sign + 1));
  }
}

std::string ConfigText::value(const std::string& section, const std::string& key) const {
  const auto found = values_.find({section, key});
  return found == values_.end() || found->second == "auto" || found->second == "none" ? "" : found->second;
}

std::optional<double> ConfigText::number(const std::string& section, const std::string& key) const {
  const std::vector<double> numbers = numbers_of(value(section, key));
  return numbers.empty() ? std::nullopt : std::optional(numbers[0]);
}

Point ConfigText::point(const std::string& section, const std::string& key) const {
  const std::vector<double> numbers = numbers_of(value(section, key));
  if (numbers.size() != 2)
    throw Failure(ExitCode::usage, fmt::format("the config has no two numbers '{}' in [{}]", key, section));
  return {numbers[0], numbers[1]};
}

std::string ConfigText::path(const std::string& section, const std::string& key) const {
  const std::string name = value(section, key);
  return name.empty() || name[0] == '/' || folder_.empty() ? name : folder_ + "/" + name;
}

std::optional<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    return std::nullopt;
  return text.str();
}

std::vector<Ring> read_rings(const std::string& text) {
  std::vector<Ring> rings;
  Ring ring;
  const auto end_ring = [&] {
    if (ring.size() > 1 && ring.front().x == ring.back().x && ring.front().y == ring.back().y)
      ring.pop_back();
    if (!ring.empty())
      rings.push_back(std::move(ring));
    ring.clear();
  };
  std::string all = text + "\n";
  for (char& c : all)
    c = c == '\r' ? '\n' : c; // the code below distinguishes an empty line after CR LF from a blank one
  bool after_return = false;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] != '\n')
      continue;
    const std::string line = all.substr(begin, k - begin);
    begin = k + 1;
    const bool is_half_of_pair = line.empty() && after_return && text.size() > k && text[k] == '\n';
    after_return = text.size() > k && text[k] == '\r';
    if (is_half_of_pair)
      continue;
    const std::string content = trimmed(line.substr(0, line.find('#')));
    const std::vector<double> numbers = numbers_of(content);
    if (numbers.size() >= 2)
      ring.push_back({numbers[0], numbers[1]});
    else if (trimmed(line).empty() || content.starts_with('>'))
      end_ring();
  }
  end_ring();
  return rings;
}

} // namespace trime_check
