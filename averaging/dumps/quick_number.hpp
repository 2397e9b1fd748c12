// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace millfoam::averaging {

/// Reads numbers as they mostly are in dumps, fast. The functions begin at `text` and return where the number
/// stops, or null when it is not one of the easy ones: no number at all, too many digits, an exponent out of
/// range, or within eight bytes of `end`. `as_number` then decides; for an easy number both give the same
/// value to the last bit. A line end must come before `end`.
class QuickNumber {
 public:
  /// A decimal number with or without minus, point and exponent: m 10^e with m <= 2^53 and |e| <= 22. Both m
  /// and 10^|e| are exact in double precision, so that one multiplication or division rounds correctly.
  /// Source of the method: W. D. Clinger 1990, How to read floating point numbers accurately, PLDI.
  static const char* read(const char* text, const char* end, double& value) {
    const bool negative = *text == '-';
    const char* const begin = text + negative;
    std::uint64_t digits = 0;
    const char* place = read_few_digits(begin, digits);
    std::ptrdiff_t count = place - begin;
    std::ptrdiff_t exponent = 0;
    if (*place == '.') {
      const char* const fraction = place + 1;
      place = read_many_digits(fraction, end, digits);
      if (place == nullptr) return nullptr;
      exponent = fraction - place;
      count -= exponent;
    }
    if (count == 0 || count > most_digits || digits > most_exact) return nullptr;
    if (*place == 'e' && (place = read_exponent(place + 1, exponent)) == nullptr) return nullptr;
    if (exponent < -most_exponent || exponent > most_exponent) return nullptr;
    const auto magnitude = static_cast<double>(static_cast<std::int64_t>(digits));
    const double scaled = exponent <= 0 ? magnitude / powers[static_cast<std::size_t>(-exponent)]
                                        : magnitude * powers[static_cast<std::size_t>(exponent)];
    value = negative ? -scaled : scaled;
    return place;
  }

  /// A whole number of up to 18 digits, not negative.
  static const char* read(const char* text, const char* end, long long& value) {
    std::uint64_t digits = 0;
    const char* const place = read_many_digits(text, end, digits);
    if (place == nullptr || place == text || place - text > 18) return nullptr;
    value = static_cast<long long>(digits);
    return place;
  }

 private:
  static constexpr std::ptrdiff_t most_digits = 19;  // what 64 bits can hold
  static constexpr std::uint64_t most_exact = std::uint64_t{1} << 53U;
  static constexpr std::ptrdiff_t most_exponent = 22;
  static constexpr std::array<double, 23> powers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  static constexpr std::array<std::uint64_t, 8> small_powers{1,     10,     100,     1000,
                                                             10000, 100000, 1000000, 10000000};

  /// Appends the digits at `text` to `digits`, one by one. Too many digits overflow; their count shows it.
  static const char* read_few_digits(const char* text, std::uint64_t& digits) {
    for (unsigned digit = 0; (digit = static_cast<unsigned char>(*text) - unsigned{'0'}) <= 9; ++text) {
      digits = digits * 10 + digit;
    }
    return text;
  }

  /// The same, eight at a time: where the digits end is computed and not found by branches, which a processor
  /// often guesses wrongly.
  static const char* read_many_digits(const char* text, const char* end, std::uint64_t& digits) {
    while (end - text >= 8) {
      std::uint64_t bytes = 0;
      std::memcpy(&bytes, text, 8);
      bytes ^= 0x3030303030303030U;  // a digit's byte is now its value, any other one above 9
      const std::uint64_t others = ((bytes + 0x7676767676767676U) | bytes) & 0x8080808080808080U;
      if (others == 0) {
        digits = digits * 100000000U + eight_digits(bytes);
        text += 8;
        continue;
      }
      const auto bits = static_cast<unsigned>(__builtin_ctzll(others)) - 7;  // eight for each digit
      // The text's first digit is the lowest byte: shifted up, it gets leading zeros.
      digits = digits * small_powers[bits / 8] + eight_digits(bytes << (56 - bits) << 8U);
      return text + bits / 8;
    }
    return nullptr;
  }

  /// The number whose decimal digits are the eight bytes, the lowest first.
  static std::uint64_t eight_digits(std::uint64_t bytes) {
    bytes = bytes * 10 + (bytes >> 8U);
    constexpr std::uint64_t pairs = 0x000000FF000000FFU;
    return ((bytes & pairs) * 0x000F424000000064U + ((bytes >> 16U) & pairs) * 0x0000271000000001U) >> 32U;
  }

  static const char* read_exponent(const char* text, std::ptrdiff_t& exponent) {
    const bool negative = *text == '-';
    const char* const begin = text + (negative || *text == '+');
    std::uint64_t digits = 0;
    const char* const place = read_few_digits(begin, digits);
    if (place == begin || place - begin > 3) return nullptr;
    const auto value = static_cast<std::ptrdiff_t>(digits);
    exponent += negative ? -value : value;
    return place;
  }

  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the first digit is taken for the lowest byte");
};

}  // namespace millfoam::averaging
