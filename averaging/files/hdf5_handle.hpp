// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

/// The HDF5 library as this room uses it: identifiers that close themselves, failures as exceptions, one
/// thread at a time.
namespace millfoam::averaging::hdf5 {

/// What the HDF5 library could not do; the message does not name the file, the caller adds it.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Owns one HDF5 identifier and closes it.
class Handle {
 public:
  /// HDF5's function that closes this kind of identifier.
  using Close = herr_t (*)(hid_t);

  /// Takes over what an HDF5 call returned. Throws Error("cannot " + `action`) when the call had failed.
  Handle(hid_t id, Close closer, const std::string& action) : id_(id), close_(closer) {
    if (id_ < 0) throw Error("cannot " + action);
  }
  /// Takes over the identifier; `other` has none any more.
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  hid_t get() const { return id_; }  ///< for HDF5's functions; still owned by this object

  /// Closes now, so that a failure can be reported. Throws Error("cannot " + `action`).
  void close(const std::string& action) {
    if (close_(std::exchange(id_, H5I_INVALID_HID)) < 0) throw Error("cannot " + action);
  }

 private:
  hid_t id_;
  Close close_;
};

/// Throws Error("cannot " + `action`) when an HDF5 call has failed.
inline void check(herr_t status, const std::string& action) {
  if (status < 0) throw Error("cannot " + action);
}

/// While it lives, HDF5 does not print its own stack of errors; afterwards it does what it did before.
///
/// Also takes away HDF5's work at the program's exit: where a full disk kept a file from being flushed, the
/// handler of HDF5 1.10 crashes on what is left of it. All that is opened here is closed by its handle. That
/// has an effect only before the library's first other call, so it is done here.
class QuietErrors {
 public:
  QuietErrors() {
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// The HDF5 library serves one thread at a time.
inline std::recursive_mutex& library_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

/// Runs `action` with HDF5 silent and for this thread alone, and turns its Error into an `Exception` that
/// begins with the file's name.
template <typename Exception, typename Action>
auto naming_file(const std::filesystem::path& path, Action&& action) {
  const std::lock_guard<std::recursive_mutex> alone(library_mutex());
  const QuietErrors quiet;
  try {
    return action();
  } catch (const Error& error) {
    throw Exception(path.string() + ": " + error.what());
  }
}

}  // namespace millfoam::averaging::hdf5
