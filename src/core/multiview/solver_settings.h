#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_SETTINGS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_SETTINGS_H

#include "core/multiview/sequence.h"
#include "core/multiview/solver.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/multiview_options.h"

namespace light_field_depth::multiview
{
/// Pixels of disparity of the solver in one of the light field: with the solver's, the outermost view stands
/// four steps away.
double solverUnit(const LightField& light_field);

/// The light field with the solver's unit of disparity.
LightField inSolverUnit(LightField light_field, double unit);

/// What the options ask for, fitted to what was measured.
/// @param light_field in pixels of disparity, of which the solver has `unit` times as many
SolverSettings solverSettings(const MultiviewOptions& options, const SceneMeasures& measures,
                              const LightField& light_field, double unit);

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_MULTIVIEW_SOLVER_SETTINGS_H
