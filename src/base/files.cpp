// SPDX-License-Identifier: BSD-2-Clause
#include "base/files.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/interruption.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kReadStep = std::size_t{1} << 20;
constexpr std::size_t kUnpackStep = std::size_t{16} << 20;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void fail(const std::string& shownName, const std::string& message) {
  SourceLocation at;
  at.file = std::make_shared<const std::string>(shownName);
  throw SceneError(at, message);
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int fd() const { return fd_; }

 private:
  int fd_;
};

struct Free {
  void operator()(char* p) const { std::free(p); }
};

/// Bytes that grow by realloc, which moves big blocks by their pages: growing never holds two copies.
class GrowingBytes {
 public:
  char* end() { return data_.get() + size_; }
  std::size_t room() const { return capacity_ - size_; }
  std::size_t size() const { return size_; }
  const char* data() const { return data_.get(); }
  void wrote(std::size_t count) { size_ += count; }
  void makeRoom(std::size_t atLeast) {
    if (room() >= atLeast) return;
    resize(std::max(size_ + atLeast, capacity_ + capacity_ / 2));
  }
  /// Hands the bytes over, shrunk to their size.
  char* release() {
    if (size_ > 0 && size_ < capacity_) resize(size_);
    return data_.release();
  }

 private:
  void resize(std::size_t capacity) {
    char* p = static_cast<char*>(std::realloc(data_.get(), capacity));
    if (!p) throw std::bad_alloc();
    (void)data_.release();
    data_.reset(p);
    capacity_ = capacity;
  }
  std::unique_ptr<char, Free> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

bool isGzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

/// Git LFS leaves a few lines in the place of a big file until it is fetched.
void refuseLfsPointer(std::string_view text, const std::string& shownName) {
  constexpr std::string_view kHead = "version https://git-lfs.github.com/spec/";
  constexpr std::size_t kMaxPointer = 1024;
  if (text.size() > kMaxPointer || text.substr(0, kHead.size()) != kHead) return;
  fail(shownName, '"' + shownName +
                      "\" is a Git LFS pointer, which stands for a file that was not fetched; run \"git lfs "
                      "pull\" in its repository");
}

class Inflater {
 public:
  Inflater() {
    constexpr int kGzipOnly = 15 + 16;  // zlib: largest window, gzip header expected
    if (inflateInit2(&stream_, kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
};

GrowingBytes unpack(std::string_view packed, const std::string& shownName, std::size_t maxUnpacked) {
  GrowingBytes out;
  const std::uint64_t most = std::min<std::uint64_t>(maxUnpacked, mostUnpacked(packed.size()));
  Inflater inflater;
  z_stream& z = inflater.stream();
  std::size_t used = 0;
  for (;;) {
    const auto inNow = static_cast<uInt>(std::min<std::size_t>(packed.size() - used, kReadStep));
    out.makeRoom(std::min(kReadStep, 4 * packed.size() + 64));
    const auto outNow = static_cast<uInt>(std::min<std::size_t>(out.room(), kUnpackStep));
    // zlib's interface is older than const.
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + used));
    z.avail_in = inNow;
    z.next_out = reinterpret_cast<Bytef*>(out.end());
    z.avail_out = outNow;
    const int status = inflate(&z, Z_NO_FLUSH);
    used += inNow - z.avail_in;
    out.wrote(outNow - z.avail_out);
    leaveIfStopped();
    if (out.size() > most) {
      fail(shownName,
           "cannot unpack \"" + shownName + "\": its " + std::to_string(packed.size()) +
               " bytes give more than " + std::to_string(most) + " bytes, the limit" +
               (most < maxUnpacked ? " for its size; unpack it by hand if it is what it should be" : ""));
    }
    if (status == Z_STREAM_END) {
      // gzip files may be joined; zeros after the end are padding.
      const std::size_t next = std::min(packed.find_first_not_of('\0', used), packed.size());
      if (next == packed.size()) return out;
      if (next != used || !isGzip(packed.substr(used))) {
        fail(shownName, "cannot unpack \"" + shownName + "\": the gzip data ends at byte " +
                            std::to_string(used) + " but the file goes on");
      }
      inflateReset(&z);
    } else if (status == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      fail(shownName, "cannot unpack \"" + shownName + "\": the gzip data is corrupt near byte " +
                          std::to_string(used) + (z.msg ? " (" + std::string(z.msg) + ")" : std::string()));
    } else if (used == packed.size() && z.avail_out > 0) {
      fail(shownName, "cannot unpack \"" + shownName + "\": the gzip data is truncated");
    }
  }
}

/// Until there is something to read, or the run is to stop: a pipe may stay silent for ever.
void waitForBytes(int fd) {
  constexpr int kLook = 50;  // milliseconds
  pollfd waiting{fd, POLLIN, 0};
  do {
    leaveIfStopped();
  } while (::poll(&waiting, 1, kLook) == 0);
}

GrowingBytes readAll(int fd, const std::string& shownName) {
  GrowingBytes in;
  for (;;) {
    waitForBytes(fd);
    in.makeRoom(kReadStep);
    const ssize_t got = ::read(fd, in.end(), in.room());
    if (got == 0) return in;
    if (got > 0) {
      in.wrote(static_cast<std::size_t>(got));
    } else if (errno != EINTR) {
      fail(shownName, "cannot read \"" + shownName + "\": " + reason(errno));
    }
  }
}

}  // namespace

FileBytes FileBytes::open(const std::filesystem::path& path, std::size_t maxUnpacked) {
  const std::string shown = path.string();
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.fd() < 0 || ::fstat(file.fd(), &status) != 0) {
    fail(shown, "cannot open \"" + shown + "\": " + reason(errno));
  }
  if (S_ISDIR(status.st_mode)) fail(shown, "cannot open \"" + shown + "\": it is a directory");
  if (!S_ISREG(status.st_mode)) return readDescriptor(file.fd(), shown);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return {nullptr, 0, false};
  void* map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd(), 0);
  if (map == MAP_FAILED) return readDescriptor(file.fd(), shown);  // some file systems cannot map
  ::madvise(map, size, MADV_SEQUENTIAL);
  FileBytes mapped(static_cast<const char*>(map), size, true);
  if (!isGzip(mapped.text())) {
    refuseLfsPointer(mapped.text(), shown);
    return mapped;
  }
  GrowingBytes plain = unpack(mapped.text(), shown, maxUnpacked);
  const std::size_t plainSize = plain.size();
  return {plain.release(), plainSize, false};
}

FileBytes FileBytes::readDescriptor(int descriptor, const std::string& shownName) {
  GrowingBytes bytes = readAll(descriptor, shownName);
  if (isGzip({bytes.data(), bytes.size()})) {
    bytes = unpack({bytes.data(), bytes.size()}, shownName, std::numeric_limits<std::size_t>::max());
  } else {
    refuseLfsPointer({bytes.data(), bytes.size()}, shownName);
  }
  const std::size_t size = bytes.size();
  return {bytes.release(), size, false};
}

FileBytes::FileBytes(FileBytes&& o) noexcept
    : data_(std::exchange(o.data_, nullptr)), size_(std::exchange(o.size_, 0)), mapped_(o.mapped_) {}

FileBytes& FileBytes::operator=(FileBytes&& o) noexcept {
  std::swap(data_, o.data_);
  std::swap(size_, o.size_);
  std::swap(mapped_, o.mapped_);
  return *this;
}

FileBytes::~FileBytes() {
  char* p = const_cast<char*>(data_);  // ours to give back
  if (mapped_) {
    if (p) ::munmap(p, size_);
  } else {
    std::free(p);
  }
}

void FileBytes::releaseUpTo(std::size_t count) const {
  static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  // Only whole pages of ours: the first and the last may be shared with other allocations.
  const auto first = reinterpret_cast<std::uintptr_t>(data_);
  const std::uintptr_t begin = (first + page - 1) / page * page;
  const std::uintptr_t end = (first + std::min(count, size_)) / page * page;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

namespace {

/// Temporary names are this, the number of the process, "-", a counter and the extension.
std::string partPrefix(const std::filesystem::path& target) { return '.' + target.stem().string() + ".part"; }

/// The number of the process that made a file of that name; 0: it is no such name.
pid_t processOf(std::string_view name, std::string_view prefix, std::string_view ending) {
  if (name.size() < prefix.size() + ending.size() || !name.starts_with(prefix) || !name.ends_with(ending))
    return 0;
  const char *const first = name.data() + prefix.size(), *const last =
                                                             name.data() + name.size() - ending.size();
  pid_t process = 0;
  unsigned counter = 0;
  const auto dash = std::from_chars(first, last, process);
  if (dash.ec != std::errc() || dash.ptr == last || *dash.ptr != '-' || process <= 0) return 0;
  const auto rest = std::from_chars(dash.ptr + 1, last, counter);
  return rest.ec == std::errc() && rest.ptr == last ? process : 0;
}

}  // namespace

void removeLeftParts(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  const std::string written = partPrefix(target), extension = target.extension().string(),
                    probed = '.' + target.filename().string() + ".part";  // by unwritableReason
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const pid_t process = std::max(processOf(name, written, extension), processOf(name, probed, ""));
    if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) left.push_back(entry->path());
  }
  for (const fs::path& file : left) fs::remove(file, error);
}

void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path& temporary)>& write) {
  namespace fs = std::filesystem;
  const auto failed = [&](const std::string& what, const std::string& why) {
    return std::runtime_error("cannot write \"" + path.string() + "\": " + what + why);
  };
  std::error_code error;
  // A device or pipe is written in place; through a symbolic link, the file it points to is replaced.
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  const fs::file_status old = fs::status(target, error);
  if (fs::is_directory(old)) throw failed("", "it is a directory");
  if (fs::exists(old) && !fs::is_regular_file(old)) {
    write(target);
    return;
  }
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  if (!fs::is_directory(folder, error)) throw failed("there is no folder ", folder.string());

  static std::atomic<unsigned> counter{0};
  std::string name = partPrefix(target) + std::to_string(::getpid());
  name.append("-").append(std::to_string(counter++));
  name.append(target.extension().string());  // stays: writers choose the format by it
  const fs::path temporary = folder / name;
  struct Remover {
    const fs::path& file;
    bool armed = true;
    ~Remover() {
      std::error_code ignored;
      if (armed) fs::remove(file, ignored);
    }
  } remover{temporary};

  write(temporary);
  {
    const Descriptor file(::open(temporary.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.fd() < 0) throw failed("", reason(errno));
    // Some file systems know no fsync for this kind of file (EINVAL): nothing to wait for then.
    if (::fsync(file.fd()) != 0 && errno != EINVAL) throw failed("", reason(errno));
  }
  if (fs::exists(old)) fs::permissions(temporary, old.permissions(), error);
  fs::rename(temporary, target, error);
  if (error) throw failed("", error.message());
  remover.armed = false;
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.fd() >= 0) (void)::fsync(directory.fd());  // the new name is on the disk too
}

}  // namespace pbrtmedia
