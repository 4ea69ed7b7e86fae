#include "looks/chain/read_back.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>

#include "base/error.h"
#include "looks/chain/ocio_chain.h"
#include "looks/verify/measure.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr std::size_t colours_read_back = 4096;

[[noreturn]] void fail(const std::string& path, std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  throw Error(ExitCode::output, path, "does not read back as it was made: " + what);
}

OCIO::ConstProcessorRcPtr read(const std::string& file, const std::string& path) {
  // OCIO keeps what it read under a name, and these names are used again.
  OCIO::ClearAllCaches();
  const OCIO::FileTransformRcPtr transform = OCIO::FileTransform::Create();
  transform->setSrc(file.c_str());
  transform->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
  try {
    return OCIO::Config::CreateRaw()->getProcessor(transform);
  } catch (const OCIO::Exception& e) {
    fail(path, e.what());
  }
}

Colours probes() {
  Colours out = stop_colours(colours_read_back, identity3<double>(), identity3<double>());
  for (const float r : {0.f, 1.f, -1.f, 1e-30f, 65504.f, 1e30f})
    for (const float g : {0.f, .25f, 1.f, 2.f}) {
      out.r.push_back(r);
      out.g.push_back(g);
      out.b.push_back(.5f * r);
    }
  return out;
}

/// Every value of every table, in their order.
std::vector<float> tables_of(const OCIO::ConstProcessorRcPtr& processor) {
  std::vector<float> out;
  const OCIO::GroupTransformRcPtr steps = processor->createGroupTransform();
  for (int i = 0; i < steps->getNumTransforms(); ++i) {
    const OCIO::TransformRcPtr step = steps->getTransform(i);
    std::array<float, 3> v{};
    if (const auto table = OCIO::DynamicPtrCast<OCIO::Lut1DTransform>(step)) {
      for (unsigned long k = 0; k < table->getLength(); ++k) {
        table->getValue(k, v[0], v[1], v[2]);
        out.insert(out.end(), v.begin(), v.end());
      }
    } else if (const auto cube = OCIO::DynamicPtrCast<OCIO::Lut3DTransform>(step)) {
      const unsigned long n = cube->getGridSize();
      for (unsigned long k = 0; k < n * n * n; ++k) {
        cube->getValue(k / (n * n), k / n % n, k % n, v[0], v[1], v[2]);
        out.insert(out.end(), v.begin(), v.end());
      }
    }
  }
  return out;
}

bool same(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

}  // namespace

void require_read_back(const std::string& file, const std::string& path, const Chain& chain) {
  const OCIO::ConstProcessorRcPtr written = read(file, path);
  const OCIO::ConstProcessorRcPtr wanted = OCIO::Config::CreateRaw()->getProcessor(ocio_transform(chain));
  if (!same(tables_of(wanted), tables_of(written))) fail(path, "a number of its tables is another");
  const auto run = [](const OCIO::ConstProcessorRcPtr& processor, Colours& colours) {
    scotopic::apply(processor->getOptimizedCPUProcessor(OCIO::BIT_DEPTH_F32, OCIO::BIT_DEPTH_F32,
                                                        OCIO::OPTIMIZATION_LOSSLESS),
                    colours);
  };
  Colours meant = probes(), got = meant;
  run(wanted, meant);
  run(written, got);
  if (!same(meant.r, got.r) || !same(meant.g, got.g) || !same(meant.b, got.b))
    fail(path, "colours come out otherwise");
}

void require_config(const std::string& text, const std::string& path) {
  try {
    std::istringstream stream(text);
    OCIO::Config::CreateFromStream(stream)->validate();
  } catch (const OCIO::Exception& e) {
    fail(path, e.what());
  }
}

}  // namespace scotopic
