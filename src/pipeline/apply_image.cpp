#include "pipeline/apply_image.h"

#include "io/pixels/row_bands.h"
#include "pipeline/layer_runs.h"

namespace scotopic {

std::int64_t rows_to_write(const ImageLayout& layout) {
  std::int64_t rows = 0;
  for (const OutputSubimage& out : layout.outputs) rows += out.copy ? 0 : out.subimage.data.height();
  return rows;
}

NonFinitePixels write_subimages(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                                const ImageStages& stages, PixelSink& sink, const Progress& progress) {
  const std::int64_t total = rows_to_write(layout);
  std::int64_t done = 0;
  NonFinitePixels non_finite;
  Band in;
  for (std::size_t i = 0; i < layout.outputs.size(); ++i) {
    if (layout.outputs[i].copy) {
      sink.copy(i);
      continue;
    }
    const Subimage& subimage = source.subimages()[layout.outputs[i].source];
    // OpenEXR wants the rows in the order that its header states, the other formats from the top.
    const bool descending = subimage.descending && layout.format == "openexr";
    LayerRuns run(source, layout, config, stages, layout.outputs[i], descending, sink.interleaved());
    const auto write = [&](const Band& seen) {
      sink.write(i, seen);
      done += seen.rows;
      if (progress) progress(done, total);
    };
    each_band(subimage, descending, [&](int y0, int rows) {
      source.read(layout.outputs[i].source, y0, rows, in);
      run.run(std::move(in), write);
    });
    non_finite.add(run.non_finite());
  }
  if (stages.non_finite == NonFinite::error) refuse(non_finite, source.file());
  sink.finish();
  source.require_unchanged();
  return non_finite;
}

NonFinitePixels apply_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                            const ImageStages& stages, OutputFile& file, const Progress& progress) {
  const std::unique_ptr<PixelSink> sink = open_sink(layout.format, file, source, layout.outputs);
  const NonFinitePixels found = write_subimages(source, layout, config, stages, *sink, progress);
  file.commit();
  return found;
}

}  // namespace scotopic
