// The proof of a merge: OpenColorIO makes every way that was added.
#include <sstream>

#include "base/error.h"
#include "color/config/lost_displays.h"
#include "looks/chain/ocio_chain.h"
#include "looks/merge/config_merge.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

class Proof {
 public:
  Proof(const MergedConfig& merged, const ColourConfig& config, const LookSet& set)
      : file_(config.file()), working_(config.working_space()) {
    std::istringstream in(merged.text);
    config_ = OCIO::Config::CreateFromStream(in)->createEditableCopy();
    config_->setWorkingDir(config.ocio()->getWorkingDir());
    forget_lost_displays(*config_);
    require("the whole of", file_, [&] { config_->validate(); });
    if (config_->getMajorVersion() < 2)
      config_->setMajorVersion(2);  // for steps that profile 1 has in files only
    for (const LookEntry& entry : set.entries)
      for (std::size_t i = 0; i < set.looks.size(); ++i)
        if (entry.file == set.luts[i].name) replace_file(entry, set.looks[i].chain);
  }

  void look(const std::string& name) const {
    OCIO::LookTransformRcPtr transform = OCIO::LookTransform::Create();
    transform->setSrc(working_.c_str());
    transform->setDst(working_.c_str());
    transform->setLooks(name.c_str());
    require("look", name, [&] { (void)config_->getProcessor(transform); });
    require("colour space", name, [&] {
      (void)config_->getProcessor(working_.c_str(), name.c_str());
      (void)config_->getProcessor(name.c_str(), working_.c_str());
    });
  }

  void view(const AddedView& added) const {
    const char *display = added.display.c_str(), *view = added.view.c_str();
    require("view", added.display + "/" + added.view, [&] {
      (void)config_->getProcessor(working_.c_str(), display, view, OCIO::TRANSFORM_DIR_FORWARD);
      if (std::string(config_->getDisplayViewLooks(display, view)).find(added.view) == std::string::npos)
        throw OCIO::Exception("another view of that name is found");
      if (!offered(display, view)) throw OCIO::Exception("the display does not offer it");
    });
  }

 private:
  /// Which need not be there yet, and is read back by itself.
  void replace_file(const LookEntry& entry, const Chain& chain) {
    const OCIO::LookRcPtr look = config_->getLook(entry.name.c_str())->createEditableCopy();
    look->setTransform(ocio_transform(chain));
    config_->addLook(look);
  }

  bool offered(const char* display, const std::string& view) const {
    for (int v = 0; v < config_->getNumViews(display); ++v)
      if (view == config_->getView(display, v)) return true;
    return false;
  }

  template <typename Make>
  void require(const char* kind, const std::string& name, Make make) const {
    try {
      make();
    } catch (const OCIO::Exception& e) {
      throw Error(ExitCode::config, file_,
                  std::string("with the looks added, ") + kind + " '" + name +
                      "' does not load, so nothing is written: " + e.what());
    }
  }

  std::string file_, working_;
  OCIO::ConfigRcPtr config_;
};

}  // namespace

void require_all_load(const MergedConfig& merged, const ColourConfig& config, const LookSet& set) {
  const Proof proof(merged, config, set);
  for (const LookEntry& entry : set.entries) proof.look(entry.name);
  for (const AddedView& view : merged.views) proof.view(view);
}

}  // namespace scotopic
