// Words and numbers of a text file, line by line, without copies and without the locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace csgrun {

/// Reads words separated by blanks. A comment character ends a word and hides the rest of its line.
class TextScanner {
 public:
  /// Lines end in a line feed, or, in text that has none, in a carriage return, as of old Macs.
  explicit TextScanner(std::string_view text, char comment = '\0')
      : TextScanner(text, comment, line_end_of(text)) {}
  TextScanner(std::string_view text, char comment, char line_end)
      : at_(text.data()), end_(text.data() + text.size()), comment_(comment), line_end_(line_end) {}

  static char line_end_of(std::string_view text) {
    return text.find('\n') == std::string_view::npos ? '\r' : '\n';
  }

  /// The next word of this line; empty at the end of the line.
  std::string_view word() {
    return word_until([this](char c) { return c == comment_ && comment_ != '\0'; }, comment_);
  }

  /// The same, of a name: nothing is a comment within it, as in "part#3", nor where a word goes on,
  /// as in "#3".
  std::string_view word_of_name() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const bool is_name = end_ - at_ > 1 && !is_blank(at_[1]) && at_[1] != line_end_;
    return word_until([](char) { return false; }, is_name ? '\0' : comment_);
  }

  /// What is left of this line without blanks around it. Nothing in it is a comment: "#ff0000" is a
  /// good name.
  std::string_view rest_of_line() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* begin = at_;
    while (at_ != end_ && *at_ != line_end_) ++at_;
    const char* last = at_;
    while (last != begin && is_blank(last[-1])) --last;
    return {begin, static_cast<size_t>(last - begin)};
  }

  /// Goes to the start of the next line; false at the end of the text.
  bool next_line() {
    while (at_ != end_ && *at_ != line_end_) ++at_;
    if (at_ == end_) return false;
    ++at_;
    ++line_;
    return at_ != end_;
  }

  /// The next word on this line or on one of those that follow; empty at the end of the text.
  std::string_view word_anywhere() {
    for (;;) {
      const std::string_view w = word();
      if (!w.empty() || !next_line()) return w;
    }
  }

  /// Whether nothing but blanks and a comment is left of this line.
  [[nodiscard]] bool is_line_end() const {
    const char* p = at_;
    while (p != end_ && is_blank(*p)) ++p;
    return p == end_ || *p == line_end_ || (*p == comment_ && comment_ != '\0');
  }

  /// 1-based.
  [[nodiscard]] size_t line() const { return line_; }
  [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }
  /// How many bytes are left.
  [[nodiscard]] size_t remaining() const { return static_cast<size_t>(end_ - at_); }

 private:
  template <class Ends>
  std::string_view word_until(Ends ends, char comment) {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    const char* begin = at_;
    if (at_ != end_ && *at_ == comment && comment != '\0') {
      while (at_ != end_ && *at_ != line_end_) ++at_;
      return {};
    }
    while (at_ != end_ && !is_blank(*at_) && *at_ != line_end_ && !ends(*at_)) ++at_;
    return {begin, static_cast<size_t>(at_ - begin)};
  }

  [[nodiscard]] bool is_blank(char c) const {
    return c == ' ' || c == '\t' || (c == '\r' && c != line_end_) || c == '\f' || c == '\v';
  }

  const char* at_;
  const char* end_;
  size_t line_ = 1;
  char comment_, line_end_;
};

/// A small letter for a capital one of ASCII.
inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// Whether a decimal number that is beyond the range of double is too small for it, not too large:
/// by the power of ten of its first digit other than 0.
inline bool is_too_small(std::string_view number) {
  const size_t e = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, e);
  const auto point = static_cast<int64_t>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<int64_t>(digits.find_first_of("123456789"));
  std::string_view power = number.substr(std::min(e + 1, number.size()));
  if (!power.empty() && power.front() == '+') power.remove_prefix(1);
  int64_t exponent = 0;
  const auto [rest, error] = std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (error == std::errc::result_out_of_range) return power.front() == '-';
  // Against a number's own length, which is that of something in memory.
  return exponent < (first < point ? first + 1 - point : first - point);
}

/// A whole word as a finite number; numbers too small for a double are 0.
inline std::optional<double> parse_finite(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (rest != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range && is_too_small(word)) return 0.0;
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A whole word as an integer of the type asked for.
template <class Integer>
std::optional<Integer> parse_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Integer value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || rest != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace csgrun
