// Handles of the HDF5 library that close themselves, and its silence.
#pragma once

#include <hdf5.h>

#include <string>

#include "corank/result/files/hdf5_file.h"

namespace corank::result {

/// HDF5 prints its error stack to stderr unless told not to.
class QuietErrors {
 public:
  QuietErrors() {
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

/// An open HDF5 object. Throws ResultFileError(problem) where `id` is none.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& problem) : id_(id), close_(close) {
    if (id_ < 0) throw ResultFileError(problem);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

}  // namespace corank::result
