#include "python/arrays.h"

#include <climits>

namespace scotopic {
namespace {

namespace py = pybind11;

SampleType type_of(const py::array& array) {
  const py::dtype type = array.dtype();
  const bool native = type.byteorder() == '=' || type.byteorder() == '|';
  if (type.kind() == 'f' && native) {
    if (type.itemsize() == 2) return SampleType::half;
    if (type.itemsize() == 4) return SampleType::float32;
    if (type.itemsize() == 8) return SampleType::float64;
  }
  throw py::type_error("rgb must be of float16, float32 or float64, not " +
                       std::string(py::str(static_cast<const py::object&>(type))));
}

int side(py::ssize_t length) {
  if (length > INT_MAX / 4) throw py::value_error("rgb has a side of more than 536870911 pixels");
  return static_cast<int>(length);
}

}  // namespace

MemoryPixels pixels_of(const py::array& array) {
  if (array.ndim() != 3 || (array.shape(2) != 3 && array.shape(2) != 4))
    throw py::value_error("rgb must end in 3 components (R, G, B) or 4 (alpha)");
  MemoryPixels out;
  // An array that may not be written is only read: the caller sees to it.
  out.data = static_cast<std::byte*>(const_cast<void*>(array.data()));
  out.height = side(array.shape(0));
  out.width = side(array.shape(1));
  out.channels = static_cast<int>(array.shape(2));
  out.row_stride = array.strides(0);
  out.pixel_stride = array.strides(1);
  out.channel_stride = array.strides(2);
  out.type = type_of(array);
  return out;
}

}  // namespace scotopic
