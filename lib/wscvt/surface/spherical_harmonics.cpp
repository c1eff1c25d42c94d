// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "wscvt/base/error.h"
#include "wscvt/base/numbers.h"
#include "wscvt/base/portable_math.h"
#include "wscvt/surface/harmonic_transform.h"

// The hot loops are compiled three times on x86-64: for every processor, with AVX2 and with
// AVX-512. All give the same bits, because they have the same operations in the same order and
// never fuse a multiply with an add.
#if defined(__GNUC__) && defined(__x86_64__)
#define WSCVT_HAS_CLONES 1
#define WSCVT_INLINE inline __attribute__((always_inline))
#else
#define WSCVT_HAS_CLONES 0
#define WSCVT_INLINE inline
#endif

namespace wscvt {

namespace {

void check_degree(int degree) {
  if (degree < 0 || degree > maximum_harmonic_degree) {
    refuse("The degree of the spherical harmonics is " + std::to_string(degree) +
           ". Give one from 0 to " + std::to_string(maximum_harmonic_degree) + ".");
  }
}

int degree_of(std::size_t coefficients) {
  const int degree =
      static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients)))) - 1;
  if (coefficients == 0 || degree > maximum_harmonic_degree ||
      harmonic_count(degree) != coefficients) {
    refuse("A series of spherical harmonics has (degree + 1)^2 coefficients, degree 0 to " +
           std::to_string(maximum_harmonic_degree) + ", but " + std::to_string(coefficients) +
           " were given.");
  }
  return degree;
}

/// Q_mm, a constant, with the phase and the factor sqrt(2) of m > 0.
double sectoral_constant(int m) {
  double value = std::sqrt(1.0 / (4.0 * pi));
  for (int k = 1; k <= m; ++k) value *= -std::sqrt((2.0 * k + 1.0) / (2.0 * k));
  return m > 0 ? std::sqrt(2.0) * value : value;
}

struct Recurrence {
  double alpha, beta;
};

/// Q_lm = alpha z Q_l-1,m - beta Q_l-2,m for l > m; also for P_lm.
Recurrence recurrence(int l, int m) {
  const double l2 = static_cast<double>(l) * l;
  const double m2 = static_cast<double>(m) * m;
  const double k2 = static_cast<double>(l - 1) * (l - 1);
  const double alpha = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
  const double beta = l - 1 > m ? alpha * std::sqrt((k2 - m2) / (4.0 * k2 - 1.0)) : 0.0;
  return {alpha, beta};
}

/// dQ_lm/dz = derivative_factor(l, m) Q_l,m+1.
double derivative_factor(int l, int m) {
  const double ratio = std::sqrt(static_cast<double>(l + m + 1) * (l - m));
  return m == 0 ? -ratio / std::sqrt(2.0) : -ratio;
}

constexpr std::size_t lanes = 8;

/// Several directions side by side; the compiler turns the loops into vector instructions.
struct Lanes {
  double v[lanes];
};

WSCVT_INLINE Lanes operator+(const Lanes& a, const Lanes& b) {
  Lanes c;
  for (std::size_t i = 0; i < lanes; ++i) c.v[i] = a.v[i] + b.v[i];
  return c;
}
WSCVT_INLINE Lanes operator-(const Lanes& a, const Lanes& b) {
  Lanes c;
  for (std::size_t i = 0; i < lanes; ++i) c.v[i] = a.v[i] - b.v[i];
  return c;
}
WSCVT_INLINE Lanes operator*(const Lanes& a, const Lanes& b) {
  Lanes c;
  for (std::size_t i = 0; i < lanes; ++i) c.v[i] = a.v[i] * b.v[i];
  return c;
}
WSCVT_INLINE Lanes operator*(double a, const Lanes& b) {
  Lanes c;
  for (std::size_t i = 0; i < lanes; ++i) c.v[i] = a * b.v[i];
  return c;
}
WSCVT_INLINE void operator+=(Lanes& a, const Lanes& b) {
  for (std::size_t i = 0; i < lanes; ++i) a.v[i] += b.v[i];
}

/// Value, Cartesian gradient (x, y, z) and Hessian (xx, xy, xz, yz, zz; yy = -xx) of the extension.
struct ExtensionLanes {
  Lanes value, gradient[3], hessian[5];
};

/// The sums of a series for one order m on the lanes' latitudes: the factors of the cosine and of
/// the sine, with the requested derivatives by z.
struct LatitudeSums {
  Lanes cosine[3];
  Lanes sine[3];
};

/// Sums a series over its degrees. `order` = 0, 1, 2: number of derivatives.
template <int order>
WSCVT_INLINE void sum_degrees(int degree, const HarmonicSeries::Term* term, const Lanes& z,
                              LatitudeSums* sums) {
  const Lanes zero{};
  Lanes one;
  for (double& value : one.v) value = 1.0;
  for (int m = 0; m <= degree; ++m) {
    Lanes q1 = term->alpha * one;
    Lanes q2 = zero;
    Lanes g[3];
    Lanes h[3];
    for (int d = 0; d <= order; ++d) {
      const double* factor = d == 0 ? term->value : d == 1 ? term->first : term->second;
      g[d] = factor[0] * q1;
      h[d] = factor[1] * q1;
    }
    ++term;
    for (int l = m + 1; l <= degree; ++l, ++term) {
      const Lanes q = term->alpha * (z * q1) - term->beta * q2;
      q2 = q1;
      q1 = q;
      g[0] += term->value[0] * q;
      h[0] += term->value[1] * q;
      if constexpr (order > 0) {
        g[1] += term->first[0] * q;
        h[1] += term->first[1] * q;
      }
      if constexpr (order > 1) {
        g[2] += term->second[0] * q;
        h[2] += term->second[1] * q;
      }
    }
    for (int d = 0; d <= order; ++d) {
      sums[m].cosine[d] = g[d];
      sums[m].sine[d] = h[d];
    }
  }
}

/// Sums the results of `sum_degrees` over the orders.
template <int order>
WSCVT_INLINE void sum_orders(int degree, const LatitudeSums* sums, const Lanes& x, const Lanes& y,
                             ExtensionLanes& out) {
  const Lanes zero{};
  out = {};
  // (x + iy)^m and the two powers before it; missing powers have zero factors.
  Lanes c;
  for (double& value : c.v) value = 1.0;
  Lanes s = zero;
  Lanes c1 = zero;
  Lanes s1 = zero;
  Lanes c2 = zero;
  Lanes s2 = zero;
  for (int m = 0; m <= degree; ++m) {
    const Lanes* const g = sums[m].cosine;
    const Lanes* const h = sums[m].sine;
    out.value += g[0] * c + h[0] * s;
    if constexpr (order > 0) {
      out.gradient[0] += m * (g[0] * c1 + h[0] * s1);
      out.gradient[1] += m * (h[0] * c1 - g[0] * s1);
      out.gradient[2] += g[1] * c1 + h[1] * s1;
    }
    if constexpr (order > 1) {
      const double n = static_cast<double>(m) * (m - 1);
      out.hessian[0] += n * (g[0] * c2 + h[0] * s2);
      out.hessian[1] += n * (h[0] * c2 - g[0] * s2);
      out.hessian[2] += (m - 1.0) * (g[1] * c2 + h[1] * s2);
      out.hessian[3] += (m - 1.0) * (h[1] * c2 - g[1] * s2);
      out.hessian[4] += g[2] * c2 + h[2] * s2;
    }
    c2 = c1;
    s2 = s1;
    c1 = c;
    s1 = s;
    c = x * c1 - y * s1;
    s = x * s1 + y * c1;
  }
}

/// The two sums, compiled for a processor.
struct SumFunctions {
  void (*degrees)(int, const HarmonicSeries::Term*, const Lanes&, LatitudeSums*);
  void (*orders)(int, const LatitudeSums*, const Lanes&, const Lanes&, ExtensionLanes&);
};

template <int order>
void degrees_portable(int degree, const HarmonicSeries::Term* terms, const Lanes& z,
                      LatitudeSums* sums) {
  sum_degrees<order>(degree, terms, z, sums);
}

template <int order>
void orders_portable(int degree, const LatitudeSums* sums, const Lanes& x, const Lanes& y,
                     ExtensionLanes& out) {
  sum_orders<order>(degree, sums, x, y, out);
}

#if WSCVT_HAS_CLONES
#define WSCVT_CLONES(processor, instructions)                                                      \
  template <int order>                                                                             \
  __attribute__((target(instructions))) void degrees_##processor(                                  \
      int degree, const HarmonicSeries::Term* terms, const Lanes& z, LatitudeSums* sums) {         \
    sum_degrees<order>(degree, terms, z, sums);                                                    \
  }                                                                                                \
  template <int order>                                                                             \
  __attribute__((target(instructions))) void orders_##processor(                                   \
      int degree, const LatitudeSums* sums, const Lanes& x, const Lanes& y, ExtensionLanes& out) { \
    sum_orders<order>(degree, sums, x, y, out);                                                    \
  }
WSCVT_CLONES(avx2, "avx2")
WSCVT_CLONES(avx512, "avx512f")
#undef WSCVT_CLONES
#endif

template <int order>
SumFunctions sum_functions() {
#if WSCVT_HAS_CLONES
  if (__builtin_cpu_supports("avx512f")) return {degrees_avx512<order>, orders_avx512<order>};
  if (__builtin_cpu_supports("avx2")) return {degrees_avx2<order>, orders_avx2<order>};
#endif
  return {degrees_portable<order>, orders_portable<order>};
}

/// Calls store(index, lane, sums) for every direction. An incomplete last set repeats the last
/// direction.
template <int order, class Store>
void for_each_sum(int degree, const HarmonicSeries::Term* terms, const Vector3* directions,
                  std::size_t count, const Store& store) {
  const SumFunctions functions = sum_functions<order>();
  std::vector<LatitudeSums> sums(static_cast<std::size_t>(degree) + 1);
  Lanes x;
  Lanes y;
  Lanes z;
  Lanes z_before;
  ExtensionLanes out;
  for (std::size_t begin = 0; begin < count; begin += lanes) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const Vector3& u = directions[std::min(begin + i, count - 1)];
      x.v[i] = u.x();
      y.v[i] = u.y();
      z.v[i] = u.z();
    }
    // Along a grid row the latitude is constant, so only the azimuths' part changes.
    if (begin == 0 || !std::equal(z.v, z.v + lanes, z_before.v)) {
      functions.degrees(degree, terms, z, sums.data());
      z_before = z;
    }
    functions.orders(degree, sums.data(), x, y, out);
    const std::size_t filled = std::min(lanes, count - begin);
    for (std::size_t i = 0; i < filled; ++i) store(begin + i, i, out);
  }
}

template <int order>
RadialJet jet_of_lane(const ExtensionLanes& sums, std::size_t i, const Vector3& direction) {
  RadialJet jet;
  jet.radius = sums.value.v[i];
  if constexpr (order == 0) return jet;
  const Vector3 gradient(sums.gradient[0].v[i], sums.gradient[1].v[i], sums.gradient[2].v[i]);
  if constexpr (order == 1) return jet_from_extension(jet.radius, gradient, direction);
  const double xx = sums.hessian[0].v[i];
  const double xy = sums.hessian[1].v[i];
  const double xz = sums.hessian[2].v[i];
  const double yz = sums.hessian[3].v[i];
  const double zz = sums.hessian[4].v[i];
  Matrix3 hessian;
  hessian << xx, xy, xz, xy, -xx, yz, xz, yz, zz;
  return jet_from_extension(jet.radius, gradient, hessian, direction);
}

template <int order>
void sum_jets(int degree, const HarmonicSeries::Term* terms, const Vector3* directions,
              std::size_t count, RadialJet* jets) {
  for_each_sum<order>(degree, terms, directions, count,
                      [&](std::size_t index, std::size_t lane, const ExtensionLanes& sums) {
                        jets[index] = jet_of_lane<order>(sums, lane, directions[index]);
                      });
}

}  // namespace

void associated_legendre(int degree, int m, const double* cosines, const double* sines,
                         std::size_t count, double* values) {
  check_degree(degree);
  if (m < 0 || m > degree) {
    refuse("The order of an associated Legendre function is " + std::to_string(m) +
           ". Give one from 0 to the degree " + std::to_string(degree) + ".");
  }
  const double constant = sectoral_constant(m);
  for (std::size_t j = 0; j < count; ++j) values[j] = constant * portable::pow(sines[j], m);
  for (int l = m + 1; l <= degree; ++l) {
    const Recurrence step = recurrence(l, m);
    const double* previous = values;
    values += count;
    for (std::size_t j = 0; j < count; ++j) values[j] = step.alpha * cosines[j] * previous[j];
    if (l == m + 1) continue;
    const double* before = previous - count;
    for (std::size_t j = 0; j < count; ++j) values[j] -= step.beta * before[j];
  }
}

std::vector<double> harmonic_values(int degree, const Vector3* directions, std::size_t count) {
  check_degree(degree);
  const std::size_t width = harmonic_count(degree);
  std::vector<double> values(count * width);
  std::vector<std::complex<double>> power(count, 1.0);
  std::vector<Recurrence> steps(static_cast<std::size_t>(degree) + 1);
  for (int m = 0; m <= degree; ++m) {
    for (int l = m + 1; l <= degree; ++l) steps[static_cast<std::size_t>(l)] = recurrence(l, m);
    const double sectoral = sectoral_constant(m);
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3& u = directions[i];
      double* row = values.data() + i * width;
      double previous = 0.0;
      double value = sectoral;
      for (int l = m;;) {
        row[harmonic_index(l, m)] = value * power[i].real();
        if (m > 0) row[harmonic_index(l, -m)] = value * power[i].imag();
        if (++l > degree) break;
        const Recurrence& step = steps[static_cast<std::size_t>(l)];
        const double next = step.alpha * (u.z() * value) - step.beta * previous;
        previous = value;
        value = next;
      }
      power[i] = {power[i].real() * u.x() - power[i].imag() * u.y(),
                  power[i].real() * u.y() + power[i].imag() * u.x()};
    }
  }
  return values;
}

HarmonicSeries::HarmonicSeries(const std::vector<double>& coefficients)
    : degree_(degree_of(coefficients.size())) {
  terms_.reserve(harmonic_count(degree_));
  for (int m = 0; m <= degree_; ++m) {
    for (int l = m; l <= degree_; ++l) {
      Term term{};
      const Recurrence step = l > m ? recurrence(l, m) : Recurrence{sectoral_constant(m), 0.0};
      term.alpha = step.alpha;
      term.beta = step.beta;
      const auto factors = [&](int order, double scale, double(&pair)[2]) {
        pair[0] = scale * coefficients[harmonic_index(l, order)];
        pair[1] = order > 0 ? scale * coefficients[harmonic_index(l, -order)] : 0.0;
      };
      factors(m, 1.0, term.value);
      if (m > 0) factors(m - 1, derivative_factor(l, m - 1), term.first);
      if (m > 1) {
        factors(m - 2, derivative_factor(l, m - 2) * derivative_factor(l, m - 1), term.second);
      }
      terms_.push_back(term);
    }
  }
}

void HarmonicSeries::sum(const Vector3* directions, std::size_t count, double* values) const {
  for_each_sum<0>(degree_, terms_.data(), directions, count,
                  [&](std::size_t index, std::size_t lane, const ExtensionLanes& sums) {
                    values[index] = sums.value.v[lane];
                  });
}

void HarmonicSeries::sum(const Vector3* directions, std::size_t count, Derivatives derivatives,
                         RadialJet* jets) const {
  constexpr decltype(&sum_jets<0>) functions[] = {sum_jets<0>, sum_jets<1>, sum_jets<2>};
  functions[static_cast<std::size_t>(derivatives)](degree_, terms_.data(), directions, count, jets);
}

}  // namespace wscvt
