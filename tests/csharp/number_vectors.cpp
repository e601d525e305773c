// Writes what the library's numbers make of edges and of random operands, for the C# numbers to make the same of.
// SPDX-License-Identifier: MIT
//
// A file of 64-bit little-endian words but for names. Each operation: the length of its name and its characters, the
// counts of operands, of results and of rows, then the rows. Numbers are raw, sign-extended.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/math/angles.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/math/vectors.hpp"
#include "isostep/scalar/math.inl"
#include "isostep/scalar/text.hpp"

namespace iso = isostep;
using Words = std::vector<std::int64_t>;

namespace {

constexpr int kRandomRows = 4000;  // of each operation, beside the edges

class Output {
 public:
  explicit Output(const char* path) : file_(std::fopen(path, "wb")) {}
  ~Output() { ok(); }
  void word(std::int64_t value) { std::fwrite(&value, sizeof value, 1, file_); }
  void text(const std::string& text) {
    word(static_cast<std::int64_t>(text.size()));
    std::fwrite(text.data(), 1, text.size(), file_);
  }
  void words(const Words& all) { std::fwrite(all.data(), sizeof(std::int64_t), all.size(), file_); }
  bool ok() {
    if (file_ == nullptr) return false;
    const bool good = std::ferror(file_) == 0;
    const bool closed = std::fclose(file_) == 0;
    file_ = nullptr;
    return good && closed;
  }

 private:
  std::FILE* file_;
};

/// Ends, ones, powers of two and their neighbours, multiples of pi/2: where roundings and cases change.
template <class F> Words edges_of() {
  Words all = {0, F::highest().raw(), F::lowest().raw(), F::highest().raw() - 1, F::lowest().raw() + 1};
  for (int bit = 0; bit < F::kBits - 1; ++bit) {
    const std::int64_t power = std::int64_t{1} << bit;
    for (const std::int64_t raw : {power - 1, power, power + 1}) {
      all.push_back(static_cast<typename F::Raw>(raw));
      all.push_back(static_cast<typename F::Raw>(-raw));
    }
  }
  for (int quarters = 1; quarters <= 8; ++quarters) {
    const auto raw = iso::from_double<F>(quarters * 1.57079632679489661923).raw();
    for (const auto near : {raw - 1, raw, raw + 1}) all.push_back(near);
  }
  return all;
}

class Operands {
 public:
  template <class F> F draw() {  // every magnitude as often as every other
    const std::uint64_t bits = std::uint64_t{random_.next()} << 32 | random_.next();
    const int shift = static_cast<int>(iso::random_below(random_, F::kBits));
    const auto raw = static_cast<typename F::Raw>(bits >> (64 - F::kBits));
    return F::from_raw(static_cast<typename F::Raw>(raw >> shift));
  }
  template <class U> iso::Quat<U> turn() {  // of unit norm, or near it
    return iso::normalise(iso::Quat<U>{draw<U>(), draw<U>(), draw<U>(), draw<U>()});
  }

 private:
  iso::Pcg32 random_ = iso::Pcg32::seeded(20, 22);
};

class Vectors {
 public:
  explicit Vectors(Output& out) : out_(out) {}
  void begin(const std::string& name, int operands, int results) {
    name_ = name;
    operands_ = operands;
    results_ = results;
    rows_.clear();
  }
  void row(const Words& operands, const Words& results) {
    if (static_cast<int>(operands.size()) != operands_ || static_cast<int>(results.size()) != results_) std::abort();
    rows_.insert(rows_.end(), operands.begin(), operands.end());
    rows_.insert(rows_.end(), results.begin(), results.end());
  }
  void end() {
    out_.text(name_);
    for (const int n : {operands_, results_, static_cast<int>(rows_.size()) / (operands_ + results_)}) out_.word(n);
    out_.words(rows_);
  }

 private:
  Output& out_;
  std::string name_;
  int operands_ = 0, results_ = 0;
  Words rows_;
};

template <class F> F raw(std::int64_t word) { return F::from_raw(static_cast<typename F::Raw>(word)); }
template <class T> Words of(iso::Vec3<T> v) { return {v.x.raw(), v.y.raw(), v.z.raw()}; }
template <class U> Words of(iso::Quat<U> q) { return {q.x.raw(), q.y.raw(), q.z.raw(), q.w.raw()}; }
Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// An operation of one or two numbers A and B, to a C.
template <class A, class F> void unary(Vectors& out, Operands& draw, const std::string& name, F&& operation) {
  out.begin(name, 1, 1);
  for (const std::int64_t a : edges_of<A>()) out.row({a}, {operation(raw<A>(a)).raw()});
  for (int i = 0; i < kRandomRows; ++i) {
    const A a = draw.draw<A>();
    out.row({a.raw()}, {operation(a).raw()});
  }
  out.end();
}
template <class A, class B, class F> void binary(Vectors& out, Operands& draw, const std::string& name, F&& operation) {
  out.begin(name, 2, 1);
  const Words others = edges_of<B>();
  for (const std::int64_t a : edges_of<A>()) {
    for (std::size_t i = 0; i < others.size(); i += 3) {
      out.row({a, others[i]}, {operation(raw<A>(a), raw<B>(others[i])).raw()});
    }
  }
  for (int i = 0; i < kRandomRows; ++i) {
    const A a = draw.draw<A>();
    const B b = draw.draw<B>();
    out.row({a.raw(), b.raw()}, {operation(a, b).raw()});
  }
  out.end();
}

template <class F> void arithmetic(Vectors& out, Operands& draw, const std::string& name) {
#define ISO_UNARY(word, expression) unary<F>(out, draw, name + "." word, [](F a) { return expression; })
#define ISO_BINARY(word, expression) binary<F, F>(out, draw, name + "." word, [](F a, F b) { return expression; })
  ISO_BINARY("+", a + b);
  ISO_BINARY("-", a - b);
  ISO_BINARY("*", a * b);
  ISO_BINARY("/", a / b);
  ISO_UNARY("negate", -a);
  ISO_UNARY("Abs", iso::abs(a));
  ISO_BINARY("Min", iso::min(a, b));
  ISO_BINARY("Max", iso::max(a, b));
  ISO_BINARY("<", F::from_raw(a < b ? 1 : 0));
  ISO_BINARY("SaturatingAdd", iso::saturating_add(a, b));
  ISO_BINARY("SaturatingSubtract", iso::saturating_subtract(a, b));
  ISO_UNARY("Sqrt", iso::sqrt(a));
  ISO_UNARY("Rsqrt", iso::rsqrt(a));
  ISO_UNARY("Sin", iso::sin(a));
  ISO_UNARY("Cos", iso::cos(a));
  ISO_UNARY("Tan", iso::sin(a) / iso::cos(a));
  ISO_BINARY("Atan2", iso::atan2(a, b));
  ISO_UNARY("Asin", iso::asin(a));
  ISO_UNARY("Acos", iso::acos(a));
  ISO_UNARY("Exp", iso::exp(a));
  ISO_UNARY("Log", iso::log(a));
  ISO_BINARY("Pow", iso::power_to<F>(a, b));
  ISO_UNARY("ToDouble", iso::Q32_32::from_raw(static_cast<std::int64_t>(iso::to_bits(iso::to_double(a)))));
}

/// Whole numbers and doubles of every size to a number.
template <class F> void conversions(Vectors& out, Operands& draw, const std::string& name) {
  const auto from_whole = [](iso::Q32_32 a) { return F(static_cast<std::int32_t>(a.raw() >> 32)); };
  unary<iso::Q32_32>(out, draw, name + ".from_int", from_whole);
  out.begin(name + ".FromDouble", 1, 1);
  const auto one = [&](double value) {
    out.row({static_cast<std::int64_t>(iso::to_bits(value))}, {iso::from_double<F>(value).raw()});
  };
  for (const double special :
       {0.0, -0.0, 1e300, -1e300, 1e-300, 5e-324, iso::from_bits<double>(0x7ff8000000000000u),
        iso::from_bits<double>(0x7ff0000000000000u), iso::from_bits<double>(0xfff0000000000000u)}) {
    one(special);
  }
  for (const std::int64_t a : edges_of<F>()) {
    const double value = iso::to_double(raw<F>(a)), half = iso::to_double(F::from_raw(1)) / 2;
    for (const double offset : {0.0, half, -half, half * 0.999, half * 1.001}) one(value + offset);
  }
  for (int i = 0; i < kRandomRows; ++i) {
    one(iso::to_double(draw.draw<iso::Q32_32>()) * iso::to_double(draw.draw<iso::Q32_32>()));
  }
  out.end();
}

/// The decimal text that is made of a number: eight characters a word, 12 words; and the number itself comes back.
template <class F> void texts(Vectors& out, Operands& draw, const std::string& name) {
  out.begin(name + ".ToString", 1, 12);
  const auto one = [&](F a) {
    const std::string text = iso::to_text(a);
    Words words(12);
    std::memcpy(words.data(), text.data(), text.size());
    out.row({a.raw()}, words);
  };
  for (const std::int64_t a : edges_of<F>()) one(raw<F>(a));
  for (int i = 0; i < kRandomRows; ++i) one(draw.draw<F>());
  out.end();
}

template <class S> void mixed(Vectors& out, Operands& draw, const std::string& name) {
  using U = iso::Unit<S>;
  binary<S, U>(out, draw, name + ".*Unit", [](S a, U b) { return a * b; });
  unary<U>(out, draw, name + ".fromUnit", [](U a) { return iso::convert<S>(a); });
  unary<S>(out, draw, name + ".toUnit", [](S a) { return iso::convert<U>(a); });
  binary<S, S>(out, draw, name + ".DivideToUnit", [](S a, S b) { return iso::divide_to<U>(a, b); });
  unary<S>(out, draw, name + ".SinToUnit", [](S a) { return iso::sin_cos_to<U>(a).sin; });
  unary<S>(out, draw, name + ".CosToUnit", [](S a) { return iso::sin_cos_to<U>(a).cos; });
  binary<U, U>(out, draw, name + ".Atan2Units", [](U a, U b) { return iso::atan2_to<S>(a, b); });
  unary<S>(out, draw, name + ".WrapAngle", [](S a) { return iso::wrap_angle(a); });
  binary<S, S>(out, draw, name + ".AngleDifference", [](S a, S b) { return iso::angle_difference(a, b); });
  unary<S>(out, draw, name + ".ToDegrees", [](S a) { return iso::to_degrees(a); });
  unary<S>(out, draw, name + ".ToRadians", [](S a) { return iso::to_radians(a); });
  out.begin(name + ".TurnTowards", 3, 1);
  for (int i = 0; i < kRandomRows; ++i) {
    const S from = draw.draw<S>(), to = draw.draw<S>(), most = draw.draw<S>();
    out.row({from.raw(), to.raw(), most.raw()}, {iso::turn_towards(from, to, most).raw()});
  }
  out.end();
  out.begin(name + ".LerpAngle", 3, 1);
  for (int i = 0; i < kRandomRows; ++i) {
    const S from = draw.draw<S>(), to = draw.draw<S>();
    const U t = draw.draw<U>();
    out.row({from.raw(), to.raw(), t.raw()}, {iso::lerp_angle(from, to, t).raw()});
  }
  out.end();
}

/// Vectors whose components differ in size as they may, or hardly, or not at all.
template <class T> iso::Vec3<T> vector(Operands& draw, int i) {
  const T x = draw.draw<T>();
  if (i % 8 == 0) return {x, T(0), T(0)};
  if (i % 8 == 1) return {x, x, -x};
  if (i % 64 == 2) return iso::Vec3<T>::zero();
  if (i % 64 == 3) return {T::highest(), T::lowest(), T::lowest()};
  return {x, draw.draw<T>(), draw.draw<T>()};
}

template <class T> void vectors_of(Vectors& out, Operands& draw, const std::string& name) {
  out.begin(name + ".products", 6, 4);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto a = vector<T>(draw, i), b = vector<T>(draw, i / 8);
    out.row(of(a) + of(b), Words{iso::dot(a, b).raw()} + of(iso::cross(a, b)));
  }
  out.end();
  out.begin(name + ".Normalise", 3, 4);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto v = vector<T>(draw, i);
    const auto heading = iso::heading_of(v);
    out.row(of(v), Words{heading.length.raw()} + of(heading.direction));
  }
  out.end();
}

template <class S> void vectors(Vectors& out, Operands& draw, const std::string& name) {
  using U = iso::Unit<S>;
  vectors_of<S>(out, draw, name + ".Vec3");
  vectors_of<U>(out, draw, name + ".UnitVec3");
  out.begin(name + ".Vec3.length", 7, 6);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto a = vector<S>(draw, i), b = vector<S>(draw, i / 8);
    const S most = draw.draw<S>();
    out.row(of(a) + of(b) + Words{most.raw()}, of(iso::clamp_length(a, most)) + of(iso::move_towards(a, b, most)));
  }
  out.end();
  out.begin(name + ".Vec3.direction", 6, 9);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto v = vector<S>(draw, i);
    const auto n = iso::normalise(vector<S>(draw, i / 8));
    out.row(of(v) + of(n),
            of(iso::project_on_line<S>(v, n)) + of(iso::project_on_plane<S>(v, n)) + of(iso::reflect<S>(v, n)));
  }
  out.end();
  out.begin(name + ".Vec3.angles", 9, 2);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto a = vector<S>(draw, i), b = vector<S>(draw, i / 8), axis = vector<S>(draw, i / 3);
    out.row(of(a) + of(b) + of(axis), {iso::angle_between(a, b).raw(), iso::signed_angle(a, b, axis).raw()});
  }
  out.end();
}

template <class S> void rotations(Vectors& out, Operands& draw, const std::string& name) {
  using U = iso::Unit<S>;
  out.begin(name + ".Quat.turns", 14, 14);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto a = draw.turn<U>(), b = draw.turn<U>();
    const auto v = vector<S>(draw, i);
    const auto n = iso::normalise(vector<S>(draw, i / 8));
    out.row(of(a) + of(b) + of(v) + of(n),
            of(a * b) + of(iso::conjugate(a)) + of(iso::rotate(a, v)) + of(iso::rotate(b, n)));
  }
  out.end();
  out.begin(name + ".Quat.Normalise", 4, 4);
  for (int i = 0; i < kRandomRows; ++i) {
    iso::Quat<U> q = {draw.draw<U>(), draw.draw<U>(), draw.draw<U>(), draw.draw<U>()};
    if (i == 0) q = {U(0), U(0), U(0), U(0)};
    out.row(of(q), of(iso::normalise(q)));
  }
  out.end();
  out.begin(name + ".Quat.axes", 7, 8);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto v = vector<S>(draw, i);
    const auto axis = iso::normalise(v);
    const S angle = draw.draw<S>();
    out.row(of(axis) + Words{angle.raw()} + of(v), of(iso::rotation(axis, angle)) + of(iso::rotation_by(v)));
  }
  out.end();
  out.begin(name + ".Quat.between", 9, 13);
  for (int i = 0; i < kRandomRows; ++i) {
    const auto a = draw.turn<U>(), b = i % 16 == 0 ? a : draw.turn<U>();
    const U t = iso::abs(draw.draw<U>() * U(0.5));
    const auto turn = iso::axis_angle_of<S>(a);
    out.row(of(a) + of(b) + Words{t.raw()}, of(iso::slerp(a, b, t)) + of(iso::nlerp(a, b, t)) + of(turn.axis) +
                                                Words{turn.angle.raw(), iso::angle_between<S>(a, b).raw()});
  }
  out.end();
}

/// Seed, stream and bounds; then what the generator draws of each kind, one after another.
void random_numbers(Vectors& out, Operands& draw) {
  out.begin("Pcg32", 4, 5);
  for (int i = 0; i < kRandomRows; ++i) {
    const std::int64_t seed = draw.draw<iso::Q32_32>().raw(), stream = draw.draw<iso::Q32_32>().raw();
    const auto a = draw.draw<iso::Q16_16>(), b = draw.draw<iso::Q16_16>();
    const std::int32_t low = iso::min(a, b).raw() / 2, high = iso::max(a, b).raw() / 2;
    iso::Pcg32 random = iso::Pcg32::seeded(static_cast<std::uint64_t>(seed), static_cast<std::uint64_t>(stream));
    Words drawn = {random.next()};
    drawn.push_back(iso::random_below(random, static_cast<std::uint32_t>(high - low) + 1));
    drawn.push_back(iso::random_between(random, low, high));
    drawn.push_back(iso::uniform(random, iso::Q16_16::from_raw(low), iso::Q16_16::from_raw(high)).raw());
    drawn.push_back(iso::uniform(random, iso::Q32_32(low), iso::Q32_32(high)).raw());
    out.row({seed, stream, low, high}, drawn);
  }
  out.end();
}

template <class S> void all_of(Vectors& out, Operands& draw, const std::string& name) {
  using U = iso::Unit<S>;
  arithmetic<S>(out, draw, name);
  arithmetic<U>(out, draw, name + "Unit");
  conversions<S>(out, draw, name);
  conversions<U>(out, draw, name + "Unit");
  texts<S>(out, draw, name);
  texts<U>(out, draw, name + "Unit");
  mixed<S>(out, draw, name);
  vectors<S>(out, draw, name);
  rotations<S>(out, draw, name);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: number_vectors FILE\n");
    return 64;
  }
  Output file(argv[1]);
  Vectors out(file);
  Operands draw;
  all_of<iso::Q16_16>(out, draw, "Q16");
  all_of<iso::Q32_32>(out, draw, "Q32");
  random_numbers(out, draw);
  return file.ok() ? 0 : 74;
}
