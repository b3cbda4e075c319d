// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/formula.hpp"

#include "core/angle.hpp"
#include "core/distance_formula.hpp"
#include "core/elementary.hpp"
#include "core/object_pool.hpp"
#include "core/quoted.hpp"
#include "trime/core/error.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace trime {
namespace {

/// @brief Replaces all functions of the parser and its power by ours, and has it compute what is written: muParser
/// would turn a x + b x into (a + b) x, and its library may fuse products and sums on some processors.
void define_functions(mu::Parser& parser);

/// @brief The text as the parser must see it, as long as before: muParser's own `^` cannot be replaced, so ours has
/// another sign there.
std::string with_our_power(std::string text);

/// @brief Takes that back, for messages.
std::string with_usual_power(std::string text);

constexpr char power_sign = '\x7f'; // no text of a user has it: control characters are refused

double square_root(double x) {
  return std::sqrt(x); // IEEE 754 says how it is rounded
}

double magnitude(double x) {
  return std::fabs(x);
}

double sign(double x) {
  return x < 0 ? -1 : x > 0 ? 1 : 0;
}

/// The nearest integer; halves go up, as always in formulas.
double nearest_integer(double x) {
  const double below = std::floor(x);
  return x - below >= 0.5 ? below + 1 : below;
}

double sum(const double* list, int count) {
  double total = 0;
  for (int k = 0; k < count; ++k)
    total += list[k];
  return total;
}

double average(const double* list, int count) {
  return sum(list, count) / count;
}

double least(const double* list, int count) {
  double value = list[0];
  for (int k = 1; k < count; ++k)
    value = std::min(value, list[k]);
  return value;
}

double greatest(const double* list, int count) {
  double value = list[0];
  for (int k = 1; k < count; ++k)
    value = std::max(value, list[k]);
  return value;
}

void replace(std::string& text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
}

void define_functions(mu::Parser& parser) {
  parser.EnableOptimizer(false);
  parser.ClearFun();
  parser.DefineFun("sin", elementary::sin);
  parser.DefineFun("cos", elementary::cos);
  parser.DefineFun("tan", elementary::tan);
  parser.DefineFun("asin", elementary::asin);
  parser.DefineFun("acos", elementary::acos);
  parser.DefineFun("atan", elementary::atan);
  parser.DefineFun("atan2", elementary::atan2);
  parser.DefineFun("sinh", elementary::sinh);
  parser.DefineFun("cosh", elementary::cosh);
  parser.DefineFun("tanh", elementary::tanh);
  parser.DefineFun("asinh", elementary::asinh);
  parser.DefineFun("acosh", elementary::acosh);
  parser.DefineFun("atanh", elementary::atanh);
  parser.DefineFun("exp", elementary::exp);
  parser.DefineFun("ln", elementary::log);
  parser.DefineFun("log", elementary::log);
  parser.DefineFun("log2", elementary::log2);
  parser.DefineFun("log10", elementary::log10);
  parser.DefineFun("sqrt", square_root);
  parser.DefineFun("abs", magnitude);
  parser.DefineFun("sign", sign);
  parser.DefineFun("rint", nearest_integer);
  parser.DefineFun("sum", sum);
  parser.DefineFun("avg", average);
  parser.DefineFun("min", least);
  parser.DefineFun("max", greatest);
  const char sign_text[] = {power_sign, '\0'};
  parser.DefineOprtChars(sign_text);
  parser.DefineOprt(sign_text, elementary::pow, mu::prPOW, mu::oaRIGHT);
}

std::string with_our_power(std::string text) {
  replace(text, '^', power_sign);
  return text;
}

std::string with_usual_power(std::string text) {
  replace(text, power_sign, '^');
  return text;
}

constexpr std::size_t longest_text = 4096; // of a formula, in bytes

// No text in UTF-8 has this byte. It begins the names of the variables that stand for distances.
constexpr char distance_sign = '\xff';

/// A use of `dist(NAME)` or `grad(NAME)`, the characters [begin, end) of a formula.
struct DistanceUse {
  std::size_t begin, end;
  std::string name;
  bool is_gradient = false;

  /// Returns the variable that stands for this use, as long as the use itself.
  std::string variable(std::size_t number) const {
    std::string word = distance_sign + std::to_string(number);
    word.resize(end - begin, '_');
    return word;
  }
};

/// A parser with its variables.
struct Slot {
  double x = 0, y = 0;
  std::vector<double> distances, fields;
  mu::Parser parser;

  Slot(std::string text, const std::vector<DistanceUse>& uses, const std::vector<FormulaField>& named)
      : distances(uses.size(), 1.0), fields(named.size(), 1.0) {
    const char first_letter[] = {distance_sign, '\0'};
    parser.DefineNameChars(
        (std::string("0123456789_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ") + first_letter).c_str());
    for (std::size_t k = 0; k < uses.size(); ++k) {
      text.replace(uses[k].begin, uses[k].end - uses[k].begin, uses[k].variable(k));
      parser.DefineVar(uses[k].variable(k), &distances[k]);
    }
    define_functions(parser);
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    for (std::size_t k = 0; k < named.size(); ++k)
      parser.DefineVar(named[k].name, &fields[k]);
    parser.DefineConst("pi", pi);
    parser.DefineConst("e", 0x1.5bf0a8b145769p+1);
    parser.SetExpr(with_our_power(text));
  }
};

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names{"x", "y", "pi", "e"};
  for (const auto& function : parser.GetFunDef())
    names.push_back(function.first);
  for (const auto& variable : parser.GetVar())
    if (variable.first.front() != distance_sign && variable.first != "x" && variable.first != "y")
      names.push_back(variable.first);
  return names;
}

/// Returns the names of data fields with commas after them.
std::string field_names(const mu::Parser& parser) {
  std::string text;
  for (const auto& variable : parser.GetVar())
    if (variable.first.front() != distance_sign && variable.first != "x" && variable.first != "y")
      text += variable.first + ", ";
  return text;
}

/// Says what is wrong with a token that the parser does not know.
std::string complaint_about(const mu::Parser& parser, const std::string& token) {
  if (!token.empty() && token.front() == '^') // as for the operators of muParser
    return "the operator '^' is not allowed here";
  if (!token.empty() && std::isalpha(static_cast<unsigned char>(token.front())) == 0)
    return fmt::format("'{}' cannot stand here", token);
  if (token.starts_with("dist"))
    return fmt::format("unknown name '{}'; in the formula of a size, dist() is the distance to the boundary, and "
                       "dist(NAME) that to a part of it",
                       token);
  if (token.starts_with("grad"))
    return fmt::format("unknown name '{}'; in the formula of a size, grad(NAME) is the slope of the data of "
                       "[field.NAME]",
                       token);
  const std::vector<std::string> names = known_names(parser);
  const std::string near = token.size() > 1 ? suggestion(token, names) : ""; // every letter is near to x
  return fmt::format("unknown name '{}'{}", token,
                     near.empty() ? fmt::format("; known are x, y, {}pi, e and functions such as sqrt, sin, min, max",
                                                field_names(parser))
                                  : near);
}

/// Says that `grad` has a name that no data field has.
std::string complaint_about_slope(const std::string& name, const std::vector<FormulaField>& fields) {
  std::vector<std::string> names;
  std::string list;
  for (const FormulaField& field : fields) {
    names.push_back(field.name);
    list += (list.empty() ? "" : ", ") + shown(field.name);
  }
  return fmt::format("grad({}): expected the name of a section [field.NAME]; {}{}", shown(name),
                     names.empty() ? "there is none" : "there are " + shown(list), suggestion(name, names));
}

/// Says what is wrong, without position and text.
std::string complaint(const mu::Parser& parser, const mu::ParserError& error) {
  const std::string token = with_usual_power(error.GetToken());
  switch (error.GetCode()) {
  case mu::ecUNASSIGNABLE_TOKEN:
    return complaint_about(parser, token);
  case mu::ecUNEXPECTED_EOF:
    return "the expression ends too early";
  case mu::ecMISSING_PARENS:
    return "a parenthesis is not closed";
  case mu::ecUNEXPECTED_PARENS:
    return fmt::format("'{}' cannot stand here", token);
  case mu::ecUNEXPECTED_OPERATOR:
    return fmt::format("the operator '{}' is not allowed here", token);
  case mu::ecUNEXPECTED_VAL:
  case mu::ecUNEXPECTED_VAR:
  case mu::ecUNEXPECTED_FUN:
    return fmt::format("expected an operator before '{}'", token);
  case mu::ecTOO_MANY_PARAMS:
    return fmt::format("too many arguments for '{}'", token);
  case mu::ecTOO_FEW_PARAMS:
    return fmt::format("too few arguments for '{}'", token);
  default:
    return with_usual_power(error.GetMsg());
  }
}

[[noreturn]] void reject(const std::string& where, const std::string& text, std::size_t position,
                         const std::string& why) {
  throw ConfigError(
      fmt::format("{}: expected an expression in x and y, found '{}'; at position {}: {}", where, text, position, why));
}

/// An assignment would change x or y behind our back; muParser knows no other single '='.
void reject_assignment(const std::string& where, const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '=')
      continue;
    if (k + 1 < text.size() && text[k + 1] == '=')
      ++k;
    else if (k == 0 || (text[k - 1] != '<' && text[k - 1] != '>' && text[k - 1] != '!'))
      reject(where, text, k + 1, "an expression cannot assign values; write == to compare");
  }
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

bool is_letter(char c) {
  return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::size_t after_blanks(const std::string& text, std::size_t at) {
  while (at < text.size() && is_blank(text[at]))
    ++at;
  return at;
}

/// Returns the use of `dist` whose parenthesis opens at `open`, or nothing if the parenthesis is not closed.
std::optional<DistanceUse> distance_use(const std::string& text, std::size_t begin, std::size_t open) {
  const std::size_t first = after_blanks(text, open + 1);
  if (first < text.size() && text[first] == '"') {
    const std::size_t quote = text.find('"', first + 1);
    const std::size_t close = quote == std::string::npos ? text.size() : after_blanks(text, quote + 1);
    if (close >= text.size() || text[close] != ')')
      return std::nullopt;
    return DistanceUse{begin, close + 1, text.substr(first + 1, quote - first - 1)};
  }
  const std::size_t close = text.find(')', first);
  if (close == std::string::npos)
    return std::nullopt;
  std::size_t last = close;
  while (last > first && is_blank(text[last - 1]))
    --last;
  return DistanceUse{begin, close + 1, text.substr(first, last - first)};
}

/// Returns all uses of `dist(...)` or `grad(...)`, in their order.
std::vector<DistanceUse> distance_uses(const std::string& where, const std::string& text,
                                       const std::string& word = "dist") {
  std::vector<DistanceUse> uses;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
    const std::size_t begin = at, open = after_blanks(text, begin + word.size());
    at = begin + word.size();
    if ((begin > 0 && is_letter(text[begin - 1])) || open >= text.size() || text[open] != '(')
      continue;
    const std::optional<DistanceUse> use = distance_use(text, begin, open);
    if (!use)
      reject(where, text, open + 1, fmt::format("the parenthesis of {}(NAME) is not closed", word));
    at = use->end;
    uses.push_back(*use);
  }
  return uses;
}

/// Puts the text of the user in the place of each variable that stands for a distance.
std::string with_distances(std::string message, const std::string& text, const std::vector<DistanceUse>& uses) {
  for (std::size_t k = 0; k < uses.size(); ++k)
    if (const std::size_t at = message.find(uses[k].variable(k)); at != std::string::npos)
      message.replace(at, uses[k].end - uses[k].begin, text, uses[k].begin, uses[k].end - uses[k].begin);
  return message;
}

/// The text must be something that the parser may see.
void check_characters(const std::string& text, const std::string& where) {
  if (text.find_first_not_of(" \t") == std::string::npos)
    throw ConfigError(fmt::format("{}: expected an expression in x and y, found nothing", where));
  if (text.size() > longest_text)
    throw ConfigError(
        fmt::format("{}: expected an expression of at most {} characters, found {}", where, longest_text, text.size()));
  for (std::size_t k = 0; k < text.size(); ++k)
    if (std::iscntrl(static_cast<unsigned char>(text[k])) != 0 && text[k] != '\t')
      reject(where, text, k + 1, "control characters are not allowed in an expression");
  reject_assignment(where, text);
}

/// The parsers of a formula, one for each thread that the process could use.
struct Slots {
  std::string text, where;
  std::vector<DistanceUse> uses;
  std::vector<FormulaField> fields;
  ObjectPool<Slot> slots;

  void fill();
};

void Slots::fill() {
  const auto translate = [this](Slot& slot) {
    try {
      slot.parser.Eval(); // translates the text once
      if (slot.parser.GetNumResults() != 1)
        reject(where, text, text.find(',') + 1, "expected one value, found several values separated by ','");
    } catch (const mu::ParserError& error) {
      const auto position = static_cast<std::ptrdiff_t>(error.GetPos());
      reject(where, text, position < 0 ? 1 : static_cast<std::size_t>(position) + 1,
             with_distances(complaint(slot.parser, error), text, uses));
    }
  };
  slots.fill(translate, text, uses, fields);
}

/// @param set sets the distances of a slot
template <class Set>
double value_of(const Slots& slots, double x, double y, const Set& set) {
  const ObjectPool<Slot>::Loan loan = slots.slots.take();
  Slot& slot = *loan;
  slot.x = x;
  slot.y = y;
  set(slot);
  try {
    return slot.parser.Eval();
  } catch (const mu::ParserError&) { // a domain error of a function
    return std::numeric_limits<double>::quiet_NaN();
  }
}

} // namespace

struct Formula::Store : Slots {};

Formula::Formula(const std::string& text, const std::string& where) : store_(std::make_unique<Store>()) {
  store_->text = text;
  store_->where = where;
  check_characters(text, where);
  if (const std::vector<DistanceUse> uses = distance_uses(where, text); !uses.empty())
    reject(where, text, uses.front().begin + 1,
           "dist(NAME), the distance to the boundary, is known only in the formula of a size");
  store_->fill();
}

Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::evaluate(double x, double y) const {
  return value_of(*store_, x, y, [](Slot&) {});
}

const std::string& Formula::text() const {
  return store_->text;
}

const std::string& Formula::where() const {
  return store_->where;
}

struct DistanceFormula::Store : Slots {
  std::vector<PlaceFunction> distances;   // by use
  std::vector<std::size_t> used_fields{}; // indices of those fields that the formula uses as variables

  void add_gradients();
};

/// Adds all uses of `grad(NAME)`.
void DistanceFormula::Store::add_gradients() {
  const std::vector<DistanceUse> of_distances = uses;
  for (DistanceUse use : distance_uses(where, text, "grad")) {
    if (std::ranges::any_of(of_distances,
                            [&](const DistanceUse& of) { return of.begin < use.begin && use.begin < of.end; }))
      continue; // a part of a name
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const FormulaField& one) { return one.name == use.name; });
    if (field == fields.end())
      reject(where, text, use.begin + 1, complaint_about_slope(use.name, fields));
    use.is_gradient = true;
    uses.push_back(use);
    distances.push_back(field->slope);
  }
}

DistanceFormula::DistanceFormula(const std::string& text, const std::string& where, const DistanceLookup& lookup,
                                 std::vector<FormulaField> fields)
    : store_(std::make_unique<Store>()) {
  store_->text = text;
  store_->where = where;
  store_->fields = std::move(fields);
  check_characters(text, where);
  store_->uses = distance_uses(where, text);
  for (const DistanceUse& use : store_->uses)
    try {
      store_->distances.push_back(lookup(use.name));
    } catch (const ConfigError& error) {
      reject(where, text, use.begin + 1, error.what());
    }
  store_->add_gradients();
  store_->fill();
  const auto& variables = store_->slots.first().parser.GetUsedVar();
  for (std::size_t k = 0; k < store_->fields.size(); ++k)
    if (variables.contains(store_->fields[k].name))
      store_->used_fields.push_back(k);
}

DistanceFormula::DistanceFormula(DistanceFormula&&) noexcept = default;
DistanceFormula& DistanceFormula::operator=(DistanceFormula&&) noexcept = default;
DistanceFormula::~DistanceFormula() = default;

double DistanceFormula::evaluate(double x, double y) const {
  return value_of(*store_, x, y, [&](Slot& slot) {
    for (std::size_t k = 0; k < slot.distances.size(); ++k)
      slot.distances[k] = store_->distances[k](x, y);
    for (const std::size_t k : store_->used_fields)
      slot.fields[k] = store_->fields[k].value(x, y);
  });
}

const std::string& DistanceFormula::text() const {
  return store_->text;
}

const std::string& DistanceFormula::where() const {
  return store_->where;
}

bool DistanceFormula::uses_distances() const {
  return std::any_of(store_->uses.begin(), store_->uses.end(), [](const DistanceUse& use) { return !use.is_gradient; });
}

std::vector<std::string> DistanceFormula::fields() const {
  const std::vector<std::string> of_slopes = slopes();
  std::set<std::string> names(of_slopes.begin(), of_slopes.end());
  for (const std::size_t k : store_->used_fields)
    names.insert(store_->fields[k].name);
  return {names.begin(), names.end()};
}

std::vector<std::string> DistanceFormula::slopes() const {
  std::set<std::string> names;
  for (const DistanceUse& use : store_->uses)
    if (use.is_gradient)
      names.insert(use.name);
  return {names.begin(), names.end()};
}

bool is_word_of_formulas(const std::string& name) {
  mu::Parser parser;
  define_functions(parser);
  const std::vector<std::string> known = known_names(parser);
  return name == "dist" || name == "grad" || std::find(known.begin(), known.end(), name) != known.end();
}

} // namespace trime
