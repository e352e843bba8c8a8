#ifndef LIGHT_FIELD_DEPTH_CORE_PAPER2017_ESTIMATOR_H
#define LIGHT_FIELD_DEPTH_CORE_PAPER2017_ESTIMATOR_H

#include <string>
#include <vector>

#include "light_field_depth/core/angular_volume.h"
#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/feature_flow.h"
#include "light_field_depth/core/patch_match.h"
#include "light_field_depth/core/variational_refinement.h"

namespace light_field_depth
{
/// What finds the first matches between neighbouring views.
enum class FlowInitializer
{
  Cpm,  ///< coarse-to-fine PatchMatch, the paper's choice
  Dis   ///< OpenCV's dense inverse search, for comparison
};

/// "cpm", "dis".
std::string toString(FlowInitializer initializer);
/// The inverse of toString(). @throw InputError that lists the names.
FlowInitializer flowInitializerFromString(const std::string& name);

/// Which matches of a view are diffused.
enum class MatchDirections
{
  Forward,  ///< those to the next view of the volume, as in the paper
  Both      ///< those to both neighbours: what one hides from a view, the other may show
};

/// "forward", "both".
std::string toString(MatchDirections directions);
/// The inverse of toString(). @throw InputError that lists the names.
MatchDirections matchDirectionsFromString(const std::string& name);

/// Settings of the method of Chen, Alain and Smolic (2017).
struct Paper2017Options
{
  AngularVolumeOptions volumes;
  FlowInitializer initializer = FlowInitializer::Cpm;
  MatchDirections match_directions = MatchDirections::Forward;
  PatchMatchOptions patch_match;
  FeatureFlowOptions feature_flow;
  VariationalOptions variational;
};

std::vector<std::string> validate(const Paper2017Options& options);

/// The method of the 2017 paper: flow along angular volumes, fused on the reference view.
class Paper2017Estimator : public Estimator
{
public:
  explicit Paper2017Estimator(Paper2017Options options = {});

  void setOptions(const Paper2017Options& options) { options_ = options; }

  DisparityEstimate estimate(const LightField& light_field, const EstimateRequest& request,
                             RunContext& context) override;

private:
  Paper2017Options options_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_PAPER2017_ESTIMATOR_H
