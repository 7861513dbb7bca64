// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <concepts>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace comptonaut {

template <class T>
concept Number = std::is_arithmetic_v<T>;

/// Writes numbers, words, and structs of them (whose `members` gives a tuple) as text, numbers in the shortest form
/// that reads back as the same.
class NumberWriter {
 public:
  void put(Number auto number) { fmt::format_to(std::back_inserter(text_), "{} ", number); }
  void put(const std::string& word) { fmt::format_to(std::back_inserter(text_), "{} {} ", word.size(), word); }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value ? 1 : 0);
    if (value) put(*value);
  }
  /// In a line that ends here.
  template <class Struct>
  requires(!Number<Struct>) void put(const Struct& value) {
    std::apply([this](const auto&... member) { (put(member), ...); }, members(value));
    text_.back() = '\n';
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Reads what NumberWriter wrote. Throws std::invalid_argument where the text is something else.
class NumberReader {
 public:
  explicit NumberReader(std::string_view text) : rest_(text) {}

  void get(Number auto& number) {
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc()) refuse();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    skip_blank();
  }
  void get(std::string& word) {
    word = rest_.substr(0, size());
    rest_.remove_prefix(word.size());
    skip_blank();
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(size());
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    value.reset();
    if (size() > 0) get(value.emplace());
  }
  template <class Struct>
  requires(!Number<Struct>) void get(Struct& value) {
    std::apply([this](auto&... member) { (get(member), ...); }, members(value));
  }

  [[nodiscard]] bool done() const { return rest_.empty(); }

 private:
  [[noreturn]] static void refuse() { throw std::invalid_argument("is not what was written"); }
  /// Of what follows, which takes a byte each at least.
  std::size_t size() {
    std::size_t number = 0;
    get(number);
    if (number > rest_.size()) refuse();
    return number;
  }
  void skip_blank() {
    if (rest_.empty()) refuse();
    rest_.remove_prefix(1);
  }

  std::string_view rest_;
};

}  // namespace comptonaut
