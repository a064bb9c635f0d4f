// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pbrtmedia::test {

// Truth for estimators under an upper control, by quadrature on lines of bounds that are positive. mu: the
// extinction, control: the bound times sigma, null = control - mu.

/// Where the quadrature stands: in the middle of one of its cells.
struct ControlPoint {
  double s, width;         ///< of the cell
  double mu, control;      ///< here, 1/length
  double tau, depth, chi;  ///< integrals from the start to here of mu, control, mu^2 / control
};

/// Calls visit(point) along the line, in `cells` cells of the midpoint rule for each interval.
template <class Line, class Visit>
void walkControl(const Line& line, double sigma, Visit&& visit, int cells = 20000) {
  double tau = 0, depth = 0, chi = 0;
  line.walk([&](double sEnter, double sExit, const auto& bound) {
    const double width = (sExit - sEnter) / cells, control = sigma * static_cast<double>(bound.upper);
    for (int i = 0; i < cells; ++i) {
      const double s = sEnter + (i + .5) * width, mu = sigma * static_cast<double>(line.density(s));
      const double half = width / 2, square = mu * mu / control;
      visit(
          ControlPoint{s, width, mu, control, tau + half * mu, depth + half * control, chi + half * square});
      tau += width * mu;
      depth += width * control;
      chi += width * square;
    }
    return true;
  });
}

/// Moments of r = null / control at a point drawn with density control / depth.
struct ControlMoments {
  double tau = 0, depth = 0;    ///< integrals of mu and control over the line
  double mean = 0, square = 0;  ///< E[r], E[r^2]

  template <class Line>
  ControlMoments(const Line& line, double sigma, int cells = 20000) {
    walkControl(
        line, sigma,
        [&](const ControlPoint& p) {
          tau += p.width * p.mu;
          depth += p.width * p.control;
          mean += p.width * (p.control - p.mu);
          square += p.width * (p.control - p.mu) * (p.control - p.mu) / p.control;
        },
        cells);
    mean /= depth;
    square /= depth;
  }
};

/// E[T^2] of an estimator that walks from the start and adds at every point x_i, x_0 = start, its product of
/// null ratios times a random score, whose second moment and cross terms with what follows make up
/// A(q, T), q = exp(-control depth of the rest), T = exp(-tau of the rest):
/// A(start) + integral (null^2 / control) A(x) exp(-2 tau(a,x) + integral_a^x mu^2 / control) dx.
template <class Line, class Score>
double walkSecondMoment(const Line& line, double sigma, Score&& score, int cells = 20000) {
  const ControlMoments whole(line, sigma, cells);
  double sum = score(std::exp(-whole.depth), std::exp(-whole.tau));
  walkControl(
      line, sigma,
      [&](const ControlPoint& p) {
        const double null = p.control - p.mu;
        sum += p.width * null * null / p.control *
               score(std::exp(p.depth - whole.depth), std::exp(p.tau - whole.tau)) *
               std::exp(-2 * p.tau + p.chi);
      },
      cells);
  return sum;
}

/// E[T^2] of T = sum over j <= N of a_j r_1 ... r_j, the r independent with moments `mean` and `square`, and
/// Pr{N >= j} = reach[j].
inline double prefixSumSecondMoment(const std::vector<double>& a, const std::vector<double>& reach,
                                    double mean, double square) {
  double sum = 0, before = 0, power = 1;  // before: sum over i < j of a_i square^i mean^(j-i)
  for (std::size_t j = 0; j < a.size(); ++j) {
    sum += reach[j] * a[j] * (a[j] * power + 2 * before);
    before = mean * (before + a[j] * power);
    power *= square;
  }
  return sum;
}

}  // namespace pbrtmedia::test
