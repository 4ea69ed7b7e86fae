// What scotopic_formats.so exports.
#include "image/formats_module.h"
#include "image/oiio_sink.h"
#include "image/oiio_source.h"

extern "C" {
extern const scotopic::FormatsModule scotopic_formats;
const scotopic::FormatsModule scotopic_formats = {scotopic::open_oiio_source, scotopic::open_oiio_sink};
}
