// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

#include "base/stopwatch.h"
#include "film/film.h"
#include "image/image.h"
#include "image/metrics.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// An error that was measured.
struct ErrorRow {
  double seconds = 0, samplesPerPixel = 0;
  ErrorSummary error;
  bool isOfReference = false;  ///< else estimated from halves of the samples
};

/// `--convergence FILE.csv`: how the error of the image falls while it is rendered, a row after passes that
/// are spaced geometrically in time. Rows are in the file as soon as they are known. Against a reference, or,
/// without one, estimated from the samples of even and of odd index (Film::surrogateReference). Measuring
/// changes nothing of the image. Columns are defined in docs/convergence.md and in the file.
class ConvergenceLog {
 public:
  /// Rows to a decade of seconds, at least, where passes are not longer.
  static constexpr int kRowsPerDecade = 12;
  /// By which share the number of samples may grow in a pass, so that there are as many rows.
  static double mostGrowth();

  struct Params {
    std::filesystem::path file;
    /// Of the whole picture or of what the film shows of it.
    std::optional<Image> reference{};
    Bounds2i pixels{};                             ///< those of the film that samples are taken of
    std::string command{};                         ///< for the first line
    std::function<void(const ErrorRow&)> onRow{};  ///< gets every row with a number
  };
  /// `film` must outlive the object. Throws SceneError when the reference has other pixels, and
  /// std::runtime_error when the file cannot be written.
  ConvergenceLog(const Params& params, const Film& film);

  /// Whether it is time for a row, for which the film must be whole.
  bool isDue(const RenderResult& result) const { return result.seconds >= nextRow_; }
  /// After each pass: writes a row when it is time for one. `result` is so far.
  void afterPass(const RenderResult& result);
  /// The last row, of the image as it is, and how long measuring took.
  void finish(const RenderResult& result);

  int rows() const { return rows_; }
  const PhaseTime& measuring() const { return measuring_; }

 private:
  void writeRow(const RenderResult& result);
  /// Of the image so far; nothing while there are fewer samples than the estimate needs.
  std::optional<ErrorSummary> error(const RenderResult& result) const;

  const Film& film_;
  Bounds2i pixels_;
  std::function<void(const ErrorRow&)> onRow_;
  std::optional<Image> reference_;
  std::ofstream out_;
  int rows_ = 0;
  double nextRow_ = 0;  ///< seconds
  std::uint64_t samplesOfLastRow_ = 0;
  PhaseTime measuring_;
};

}  // namespace pbrtmedia
