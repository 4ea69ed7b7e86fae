// What scotopic_formats.so exports.
#include <OpenImageIO/imageio.h>

#include <climits>

#include "io/oiio/formats_module.h"
#include "io/oiio/oiio_sink.h"
#include "io/oiio/oiio_source.h"

namespace {

/// Its own limits do not name our options: ours decide. Which of them there are depends on its release.
void lift_limits_of_oiio() {
  OIIO::attribute("limits:channels", 65535);  // as many as a TIFF can say
  OIIO::attribute("limits:imagesize_MB", INT_MAX);
  OIIO::attribute("limits:resolution", INT_MAX);
}

}  // namespace

extern "C" {
extern const scotopic::FormatsModule scotopic_formats;
const scotopic::FormatsModule scotopic_formats = {lift_limits_of_oiio, scotopic::open_oiio_source,
                                                  scotopic::open_oiio_sink};
}
