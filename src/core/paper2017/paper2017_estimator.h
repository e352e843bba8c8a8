#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PAPER2017_ESTIMATOR_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PAPER2017_ESTIMATOR_H

#include <string>
#include <vector>

#include "core/paper2017/angular_volume.h"
#include "core/paper2017/feature_flow.h"
#include "core/paper2017/patch_match.h"
#include "core/paper2017/variational_refinement.h"
#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/paper2017_options.h"

namespace light_field_depth
{
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

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PAPER2017_PAPER2017_ESTIMATOR_H
