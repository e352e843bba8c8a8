#ifndef LIGHT_FIELD_DEPTH_CORE_PAPER2017_ESTIMATOR_H
#define LIGHT_FIELD_DEPTH_CORE_PAPER2017_ESTIMATOR_H

#include <string>
#include <vector>

#include "light_field_depth/core/estimator.h"

namespace light_field_depth
{
/// Settings of the method of Chen, Alain and Smolic (2017). Each stage adds its own struct here.
struct Paper2017Options
{
};

std::vector<std::string> validate(const Paper2017Options& options);

/// The method of the 2017 paper.
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
