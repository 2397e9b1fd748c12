// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/hdf5_file.hpp"

#include <algorithm>

#include "averaging/files/hdf5_io.hpp"

namespace millfoam::averaging::hdf5 {

namespace {

void check_is_hdf5(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    const std::filesystem::path part = path.string() + ".part";
    throw Error(std::filesystem::exists(part)
                    ? "there is no such file, only '" + part.string() + "', which is not complete"
                    : "there is no such file");
  }
  if (H5Fis_hdf5(path.c_str()) <= 0) throw Error("this is not an HDF5 file, or it cannot be read");
}

}  // namespace

Handle create_file(const std::filesystem::path& path) {
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
          "create the file (is the folder there and writable?)"};
}

Handle open_file(const std::filesystem::path& path) {
  check_is_hdf5(path);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare to open the file");
#if H5_VERSION_GE(1, 10, 7)
  check(H5Pset_file_locking(access.get(), 0, 1), "open the file without locks");
#endif
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, "open the file"};
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
