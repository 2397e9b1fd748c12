// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/hdf5_file.hpp"

#include <algorithm>
#include <fstream>

#include "averaging/files/hdf5_io.hpp"

namespace millfoam::averaging::hdf5 {

namespace {

Error damaged(const std::string& maker) {
  return Error("the file is cut short or not an HDF5 file; make it again with " + maker);
}

void check_is_hdf5(const std::filesystem::path& path, const std::string& maker) {
  if (!std::filesystem::exists(path)) {
    const std::filesystem::path part = path.string() + ".part";
    throw Error(std::filesystem::exists(part)
                    ? "there is no such file, only '" + part.string() + "', which is not complete"
                    : "there is no such file");
  }
  if (std::filesystem::is_directory(path)) throw Error("is a folder, expected a file");
  if (!std::ifstream(path)) throw Error("cannot be read: no permission");
  if (H5Fis_hdf5(path.c_str()) <= 0) throw damaged(maker);
}

}  // namespace

Handle create_file(const std::filesystem::path& path) {
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
          "create the file (is the folder there and writable?)"};
}

Handle open_file(const std::filesystem::path& path, const std::string& maker) {
  check_is_hdf5(path, maker);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare to open the file");
#if H5_VERSION_GE(1, 10, 7)
  check(H5Pset_file_locking(access.get(), 0, 1), "open the file without locks");
#endif
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (file < 0) throw damaged(maker);
  return {file, H5Fclose, "open the file"};
}

void require_format_or_nothing(const std::filesystem::path& path, const std::string& format) {
  if (!std::filesystem::exists(path)) return;
  std::string found;
  try {
    found = read_text_attribute(open_file(path).get(), "format");
  } catch (const Error&) {
    found.clear();
  }
  if (found == format) return;
  throw Error("this file exists and is not a " + format +
              " file; it would be overwritten: give another name or remove it");
}

void check_format(hid_t file, const std::string& format, const std::vector<int>& versions,
                  const std::string& advice) {
  const std::string found = read_text_attribute(file, "format");
  if (found != format) throw Error("attribute 'format' is '" + found + "', expected '" + format + "'");
  const int number = read_int_attribute(file, "version", 1)[0];
  if (std::find(versions.begin(), versions.end(), number) == versions.end()) {
    std::string expected;
    for (const int version : versions) expected += (expected.empty() ? "" : " or ") + std::to_string(version);
    throw Error("attribute 'version' is " + std::to_string(number) + ", expected " + expected + "; " +
                advice);
  }
  if (read_int_attribute(file, "complete", 1)[0] != 1) {
    throw Error("the file is not complete: the run that was to write it did not finish");
  }
}

void flush(hid_t file) {
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), "write to disk (is it full?)");
}

void rename_file(const std::filesystem::path& part, const std::filesystem::path& path) {
  std::error_code failure;
  std::filesystem::rename(part, path, failure);
  if (failure) throw Error("cannot rename it to '" + path.string() + "': " + failure.message());
}

}  // namespace millfoam::averaging::hdf5
