// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/nvdb_output.h"

#define NANOVDB_USE_ZIP
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/files.h"
#include "vdb2pbrt/vdb_density_grid.h"

namespace pbrtmedia {
namespace {

/// Memory for a grid that begins as zeros: padding between nodes is part of the file.
class ZeroedBuffer {
 public:
  ZeroedBuffer() = default;
  ZeroedBuffer(ZeroedBuffer&& o) noexcept { swap(o); }
  ZeroedBuffer& operator=(ZeroedBuffer&& o) noexcept {
    swap(o);
    return *this;
  }
  ZeroedBuffer(const ZeroedBuffer&) = delete;
  ZeroedBuffer& operator=(const ZeroedBuffer&) = delete;
  ~ZeroedBuffer() { clear(); }

  static ZeroedBuffer create(std::uint64_t size, const ZeroedBuffer* = nullptr) {
    ZeroedBuffer result;
    result.data_ = static_cast<std::uint8_t*>(::operator new(size, kAlignment));
    result.size_ = size;
    std::memset(result.data_, 0, size);
    return result;
  }
  std::uint8_t* data() { return data_; }
  const std::uint8_t* data() const { return data_; }
  std::uint64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() {
    if (data_ != nullptr) ::operator delete(data_, kAlignment);
    data_ = nullptr;
    size_ = 0;
  }

 private:
  static constexpr std::align_val_t kAlignment{NANOVDB_DATA_ALIGNMENT};
  void swap(ZeroedBuffer& o) {
    std::swap(data_, o.data_);
    std::swap(size_, o.size_);
  }
  std::uint8_t* data_ = nullptr;
  std::uint64_t size_ = 0;
};

using Handle = nanovdb::GridHandle<ZeroedBuffer>;

template <class Build>
Handle converted(const openvdb::FloatGrid& grid, float tolerance) {
  nanovdb::OpenToNanoVDB<float, Build, nanovdb::AbsDiff, ZeroedBuffer> converter;
  converter.oracle().setTolerance(tolerance);
  return converter(grid, nanovdb::StatsMode::All, nanovdb::ChecksumMode::Full, 0, ZeroedBuffer());
}

Handle converted(const openvdb::FloatGrid& grid, const NvdbOptions& options) {
  // Without leaves there is nothing to pack, and the converter to FpN expects one.
  const bool hasLeaves = grid.tree().leafCount() > 0;
  switch (hasLeaves ? options.precision : NvdbPrecision::Float) {
    case NvdbPrecision::Fp16:
      return converted<nanovdb::Fp16>(grid, options.tolerance);
    case NvdbPrecision::Fp8:
      return converted<nanovdb::Fp8>(grid, options.tolerance);
    case NvdbPrecision::Fp4:
      return converted<nanovdb::Fp4>(grid, options.tolerance);
    case NvdbPrecision::FpN:
      return converted<nanovdb::FpN>(grid, options.tolerance);
    case NvdbPrecision::Float:
      break;
  }
  return converted<float>(grid, options.tolerance);
}

}  // namespace

void writeNvdb(const std::filesystem::path& path, std::span<const VdbDensity> grids,
               const NvdbOptions& options) {
  std::vector<Handle> handles;
  for (const VdbDensity& density : grids) handles.push_back(converted(*density.grid().grid, options));
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    if (!out) throw std::runtime_error("cannot write \"" + path.string() + '"');
    nanovdb::io::writeGrids(out, handles, options.zip ? nanovdb::io::Codec::ZIP : nanovdb::io::Codec::NONE);
    out.close();
    if (!out) throw std::runtime_error("cannot write \"" + path.string() + "\": the disk is full or failing");
  });
}

}  // namespace pbrtmedia
