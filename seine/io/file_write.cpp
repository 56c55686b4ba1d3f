// Files are written whole or not at all, and what they were stays theirs: mode, owner, names.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"

namespace seine::io {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kModeBits = 07777, kNewMode = 0666;

/// Ctrl-C and the like wait until a file is as it shall be.
class Undisturbed {
 public:
  Undisturbed() {
    sigset_t late;
    sigemptyset(&late);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) sigaddset(&late, signal);
    ::pthread_sigmask(SIG_BLOCK, &late, &before_);
  }
  ~Undisturbed() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;

 private:
  sigset_t before_{};
};

/// An open file; closed with the object.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  /// False, with errno, where the file system says only now that what was written is not stored.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

[[noreturn]] void give_up(const fs::path& shown, int error) {
  throw complaint(shown.string(), 0,
                  std::string("cannot be written: ") + (error != 0 ? std::strerror(error) : "write failed"));
}

/// The file that symbolic links lead to, which need not be there yet: links keep pointing where they do.
fs::path end_of_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;  // an absolute one replaces it all
  }
  return path;
}

/// A file under no name, or under one that nobody looks for, beside the one that it will become.
class Draft {
 public:
  /// Throws nothing: false is a file system or a folder that does not take one, with errno.
  explicit Draft(const fs::path& target) : target_(target), folder_(target.parent_path()) {
    if (folder_.empty()) folder_ = ".";
#ifdef O_TMPFILE
    nameless_ = ::access("/proc/self/fd", X_OK) == 0;
    if (nameless_) number_ = ::open(folder_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kNewMode);
#endif
    if (number_ >= 0) return;
    nameless_ = false;
    number_ = named([](const fs::path& name) {
      return ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, kNewMode);
    });
  }
  ~Draft() {
    if (number_ >= 0) ::close(number_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  bool exists() const {
    return number_ >= 0;
  }
  int get() const {
    return number_;
  }

  /// Takes the place of the target. False, with errno: nothing has changed.
  bool become_target(bool replaces) {
    if (nameless_) {
      const std::string self = joined("/proc/self/fd/", number_);
      const auto link = [&](const fs::path& name) {
        return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
      };
      if (!replaces && link(target_) == 0) return true;
      if (!replaces && errno != EEXIST) return false;
      if (named(link) != 0) return false;
    }
    if (::close(std::exchange(number_, -1)) != 0) return false;
    if (::rename(name_.c_str(), target_.c_str()) != 0) return false;
    name_.clear();
    return true;
  }

 private:
  template <class Make>
  int named(Make&& make) {
    static std::atomic<int> counter{0};
    constexpr int kTries = 100;
    int made = -1;
    for (int i = 0; i < kTries; ++i) {
      const fs::path name = folder_ / joined(".seine-", ::getpid(), "-", counter.fetch_add(1), ".part");
      made = make(name);
      if (made >= 0) name_ = name;
      if (made >= 0 || errno != EEXIST) break;
    }
    return made;
  }

  fs::path target_, folder_, name_;
  int number_ = -1;
  bool nameless_ = false;
};

/// A pipe, a terminal, a device.
void write_through(const fs::path& path, std::string_view content, const fs::path& shown) {
  Descriptor out(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!out || !write_all(out.get(), content) || !out.close()) give_up(shown, errno);
}

/// Into the file itself, for one that must stay the same file: it has other names, or another owner. What is
/// there is touched only once there is room for all that comes.
void write_in_place(const fs::path& path, std::string_view content, const struct stat& old,
                    const fs::path& shown) {
  Descriptor out(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!out) give_up(shown, errno);
  const auto size = static_cast<off_t>(content.size());
  if (size > old.st_size) {
    const int error = ::posix_fallocate(out.get(), old.st_size, size - old.st_size);
    if (error != 0) {
      static_cast<void>(!::ftruncate(out.get(), old.st_size));
      give_up(shown, error);
    }
  }
  if (!write_all(out.get(), content) || ::ftruncate(out.get(), size) != 0 || !out.close())
    give_up(shown, errno);
}

/// Whether the new file can be like the old one.
bool made_alike(int file, const struct stat& old) {
  struct stat now {};
  if (::fstat(file, &now) != 0) return false;
  if ((now.st_uid != old.st_uid || now.st_gid != old.st_gid) && ::fchown(file, old.st_uid, old.st_gid) != 0)
    return false;
  return ::fchmod(file, old.st_mode & kModeBits) == 0;
}

}  // namespace

bool write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void write_file(const fs::path& path, std::string_view content) {
  const fs::path target = end_of_links(path);
  struct stat old {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;
  if (replaces && S_ISDIR(old.st_mode))
    throw complaint(path.string(), 0, "is a directory, expected a file name");
  if (replaces && !S_ISREG(old.st_mode)) return write_through(target, content, path);
  const Undisturbed undisturbed;
  if (replaces && old.st_nlink > 1) return write_in_place(target, content, old, path);
  Draft draft(target);
  if (!draft.exists() && !replaces) give_up(path, errno);
  if (!draft.exists() || (replaces && !made_alike(draft.get(), old)))
    return write_in_place(target, content, old, path);
  // What replaces a file must be on the disk before that file is gone.
  if (!write_all(draft.get(), content) || (replaces && ::fsync(draft.get()) != 0) ||
      !draft.become_target(replaces))
    give_up(path, errno);
}

}  // namespace seine::io
