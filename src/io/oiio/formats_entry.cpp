// What scotopic_formats.so exports.
#include "io/oiio/formats_module.h"
#include "io/oiio/oiio_sink.h"
#include "io/oiio/oiio_source.h"

extern "C" {
extern const scotopic::FormatsModule scotopic_formats;
const scotopic::FormatsModule scotopic_formats = {scotopic::open_oiio_source, scotopic::open_oiio_sink};
}
