// The C library's mathematics and the compiler's library of floating point, by name.
// SPDX-License-Identifier: MIT
//
// libm: whatever <math.h> and <complex.h> declare (C17 7.3, 7.12; C23 and GNU's own too), in every format, however a
// compiler decorates it: sin, sinf, sinl, sinf128, __sin_finite, _ZGVdN4v_sin. Exact ones (floor, fmin, sqrt) as well:
// a library that is not called cannot be wrong, and what is called today as floor may be round tomorrow.
//
// soft: __addsf3 and its kin, which only a target without a floating-point unit calls, or long double does (__addtf3,
// __gcc_qadd), complex numbers (__muldc3), integer powers (__powidf2, which multiplies in an order of its own).
//
// Integer helpers (__divti3, __udivdi3, __popcountdi2, __aeabi_ldivmod) are exact and stay. So do conversions between
// integers and float or double (__floatdisf, __fixdfdi, __aeabi_l2f): IEEE 754 leaves them one result, to nearest or
// towards zero. libgcc takes care to round them once; 14 million near halves agree with integers on armhf and i686.

#include "calls.hpp"

#include <regex>
#include <set>
#include <string>

namespace isostep_lint {

namespace {

/// The names without the suffix of a format.
const std::set<std::string>& mathematics() {
  static const std::set<std::string> names = {
      // C17
      "acos", "asin", "atan", "atan2", "cos", "sin", "tan", "acosh", "asinh", "atanh", "cosh", "sinh", "tanh", "exp",
      "exp2", "expm1", "frexp", "ilogb", "ldexp", "log", "log10", "log1p", "log2", "logb", "modf", "scalbn", "scalbln",
      "cbrt", "fabs", "hypot", "pow", "sqrt", "erf", "erfc", "lgamma", "tgamma", "ceil", "floor", "nearbyint", "rint",
      "lrint", "llrint", "round", "lround", "llround", "trunc", "fmod", "remainder", "remquo", "copysign", "nan",
      "nextafter", "nexttoward", "fdim", "fmax", "fmin", "fma",
      // C23
      "acospi", "asinpi", "atanpi", "atan2pi", "cospi", "sinpi", "tanpi", "exp10", "exp10m1", "exp2m1", "log10p1",
      "log2p1", "logp1", "compoundn", "pown", "powr", "rootn", "rsqrt", "roundeven", "fromfp", "ufromfp", "fromfpx",
      "ufromfpx", "nextup", "nextdown", "fmaximum", "fminimum", "fmaximum_num", "fminimum_num", "fmaximum_mag",
      "fminimum_mag", "fmaximum_mag_num", "fminimum_mag_num", "fmaxmag", "fminmag", "canonicalize", "llogb", "fadd",
      "fsub", "fmul", "fdiv", "ffma", "fsqrt", "dadd", "dsub", "dmul", "ddiv", "dfma", "dsqrt", "totalorder",
      // POSIX, GNU, Apple
      "sincos", "pow10", "drem", "gamma", "lgamma_r", "gamma_r", "j0", "j1", "jn", "y0", "y1", "yn", "scalb",
      "significand", "sincospi",
      // complex.h
      "cabs", "cacos", "cacosh", "carg", "casin", "casinh", "catan", "catanh", "ccos", "ccosh", "cexp", "cimag", "clog",
      "clog10", "conj", "cpow", "cproj", "creal", "csin", "csinh", "csqrt", "ctan", "ctanh"};
  return names;
}

bool is_mathematics(std::string name) {
  static const std::regex vectorised("_ZGV[a-z][MN][0-9x]+[a-z0-9]*_(\\w+)");
  static const std::regex decorated("_{0,2}(\\w+?)(_finite|_sse2|_avx2|_fma)?");
  static const std::regex formats("(\\w+?)(f|l|f16|f32|f64|f128|f32x|f64x|d32|d64|d128)(_r)?");
  std::smatch match;
  if (std::regex_match(name, match, vectorised)) name = match.str(1);
  if (std::regex_match(name, match, decorated)) name = match.str(1);
  if (mathematics().count(name) != 0) return true;
  return std::regex_match(name, match, formats) && mathematics().count(match.str(1) + match.str(3)) != 0;
}

bool is_soft(const std::string& name) {
  static const std::regex pattern(
      "__(add|sub|mul|div|neg|cmp|unord|eq|ne|l[te]|g[te])([hsdtxk]f|bf)[23]|"  // arithmetic and comparisons
      "__float(un)?[sdt]i[txkh]f|__fix(uns)?[txkh]f[sdt]i|"                     // integers and long double
      "__(extend|trunc)[hsdtxkb]f[hsdtxkb]f2|"                                  // formats
      "__aeabi_[fd](add|r?sub|mul|div|neg|cmp\\w+)|__aeabi_c[fd]\\w+|__aeabi_([fd]2[fdh]|h2[fd])\\w*|"
      "__gcc_q\\w+|_q_\\w+|_Q_\\w+|__(mul|div)[hsdtxk]c3|__powi[hsdtxk]f2");
  return std::regex_match(name, pattern);
}

}  // namespace

Concern concern_of_call(std::string_view symbol) {
  std::string name(symbol.substr(0, symbol.find('@')));           // the version of a symbol
  while (!name.empty() && name.front() == '.') name.erase(0, 1);  // the code of a ppc64 function
  if (name.rfind("_imp__", 0) == 0) name.erase(0, 6);
  if (name.rfind("__imp_", 0) == 0) name.erase(0, 6);
  if (is_soft(name)) return Concern::soft;
  return is_mathematics(name) ? Concern::libm : Concern::none;
}

}  // namespace isostep_lint
