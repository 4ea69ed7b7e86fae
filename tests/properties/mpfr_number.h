// A 256-bit number with the operators of a built-in one (GNU MPFR), so that one text of a formula serves
// both.
#pragma once

#include <mpfr.h>

#include <utility>

namespace scotopic::test {

/// 256 bits of mantissa, round to nearest, and an exponent range no formula here can leave.
class Mp {
 public:
  Mp() {
    mpfr_init2(value_, precision);
    mpfr_set_zero(value_, 1);
  }
  Mp(double x) : Mp() { mpfr_set_d(value_, x, MPFR_RNDN); }  // NOLINT: a number like any other
  Mp(const Mp& other) : Mp() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Mp(Mp&& other) noexcept : Mp() { mpfr_swap(value_, other.value_); }
  Mp& operator=(const Mp& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  Mp& operator=(Mp&& other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  ~Mp() { mpfr_clear(value_); }

  static Mp parse(const char* decimal) {
    Mp out;
    mpfr_set_str(out.value_, decimal, 10, MPFR_RNDN);
    return out;
  }

  static Mp from(long double x) {
    Mp out;
    mpfr_set_ld(out.value_, x, MPFR_RNDN);
    return out;
  }

  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  explicit operator float() const { return mpfr_get_flt(value_, MPFR_RNDN); }

  using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
  using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  static Mp of(Unary f, const Mp& a) {
    Mp out;
    f(out.value_, a.value_, MPFR_RNDN);
    return out;
  }
  static Mp of(Binary f, const Mp& a, const Mp& b) {
    Mp out;
    f(out.value_, a.value_, b.value_, MPFR_RNDN);
    return out;
  }

  Mp& operator*=(const Mp& b) { return *this = of(mpfr_mul, *this, b); }
  Mp& operator+=(const Mp& b) { return *this = of(mpfr_add, *this, b); }
  Mp operator-() const { return of(mpfr_neg, *this); }
  friend Mp operator+(const Mp& a, const Mp& b) { return of(mpfr_add, a, b); }
  friend Mp operator-(const Mp& a, const Mp& b) { return of(mpfr_sub, a, b); }
  friend Mp operator*(const Mp& a, const Mp& b) { return of(mpfr_mul, a, b); }
  friend Mp operator/(const Mp& a, const Mp& b) { return of(mpfr_div, a, b); }
  friend bool operator<(const Mp& a, const Mp& b) { return mpfr_less_p(a.value_, b.value_) != 0; }
  friend bool operator>(const Mp& a, const Mp& b) { return b < a; }
  friend bool operator<=(const Mp& a, const Mp& b) { return mpfr_lessequal_p(a.value_, b.value_) != 0; }
  friend bool operator>=(const Mp& a, const Mp& b) { return b <= a; }
  friend bool operator==(const Mp& a, const Mp& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }

 private:
  static constexpr mpfr_prec_t precision = 256;
  mpfr_t value_;
};

inline Mp sqrt(const Mp& x) { return Mp::of(mpfr_sqrt, x); }
inline Mp log(const Mp& x) { return Mp::of(mpfr_log, x); }
inline Mp log2(const Mp& x) { return Mp::of(mpfr_log2, x); }
inline Mp log10(const Mp& x) { return Mp::of(mpfr_log10, x); }
inline Mp exp(const Mp& x) { return Mp::of(mpfr_exp, x); }
inline Mp exp2(const Mp& x) { return Mp::of(mpfr_exp2, x); }
inline Mp pow(const Mp& x, const Mp& y) { return Mp::of(mpfr_pow, x, y); }
inline Mp atan(const Mp& x) { return Mp::of(mpfr_atan, x); }
inline Mp cbrt(const Mp& x) { return Mp::of(mpfr_cbrt, x); }
inline Mp abs(const Mp& x) { return Mp::of(mpfr_abs, x); }

/// A decimal constant in full: 0.33, not the double next to it.
template <typename Real>
Real decimal(const char* text);
template <>
inline Mp decimal<Mp>(const char* text) {
  return Mp::parse(text);
}

}  // namespace scotopic::test
