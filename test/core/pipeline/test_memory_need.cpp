#include "light_field_depth/core/memory_need.h"

#include <string>

#include <gtest/gtest.h>

#include "light_field_depth/core/error.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
TEST(MemoryNeed, IsAboveThePeaksThatWereMeasuredAndNotFarAbove)
{
  struct Measured
  {
    std::size_t views;
    int side_px;
    int type;
    Method method;
    MultiviewPreset preset;
    bool dense;
    double peak_mb;
  };
  const auto multiview = Method::Multiview;
  const auto balanced = MultiviewPreset::Balanced;
  // Of `estimate` on two threads.
  for (const Measured& measured :
       {Measured{3, 512, CV_8UC3, multiview, balanced, false, 131.5},
        Measured{9, 1024, CV_8UC3, multiview, balanced, false, 416.7},
        Measured{17, 1024, CV_8UC3, multiview, balanced, false, 498.1},
        Measured{25, 1024, CV_8UC3, multiview, balanced, false, 576.1},
        Measured{9, 1024, CV_8UC1, multiview, balanced, false, 374.4},
        Measured{9, 1024, CV_16UC3, multiview, balanced, false, 452.1},
        Measured{3, 2048, CV_8UC3, multiview, balanced, false, 1166.5},
        Measured{9, 900, CV_8UC3, multiview, balanced, false, 511.0},  // -40..40 px
        Measured{9, 1400, CV_8UC3, multiview, balanced, false, 811.2},
        Measured{9, 1024, CV_8UC3, multiview, MultiviewPreset::Realtime, false, 378.0},
        Measured{9, 1024, CV_8UC3, multiview, MultiviewPreset::Fast, false, 241.4},
        Measured{9, 1024, CV_8UC3, multiview, balanced, true, 954.0},
        Measured{25, 1024, CV_8UC3, multiview, balanced, true, 1001.9},
        Measured{3, 512, CV_8UC3, Method::Paper2017, balanced, false, 121.2},
        Measured{17, 512, CV_8UC3, Method::Paper2017, balanced, false, 266.5},
        Measured{81, 512, CV_8UC3, Method::Paper2017, balanced, false, 293.5}})
  {
    PipelineOptions options;
    options.method = measured.method;
    options.multiview.preset = measured.preset;
    ProductRequest request;
    request.dense_cloud = measured.dense;
    const double need_mb =
        memoryNeedMb({measured.views, {measured.side_px, measured.side_px}, measured.type}, options, request);
    EXPECT_GT(need_mb, measured.peak_mb) << measured.views << " views of " << measured.side_px;
    EXPECT_LT(need_mb, 2.5 * measured.peak_mb) << measured.views << " views of " << measured.side_px;
  }
}

TEST(MemoryNeed, SaysWhatWouldFitAndThatDoes)
{
  const LightFieldShape shape{289, {4000, 3000}, CV_8UC3};
  const auto refuse = [&] { requireMemory(shape, {}, {}, 8000.0, "Raise it."); };
  EXPECT_EQ(testing::messageOf<InputError>(refuse),
            "289 views of 4000 x 3000 pixels may need up to 38.47 GB, but 8.00 GB are allowed; 35 views of "
            "this size "
            "would fit, or all of them of 1818 x 1363 pixels. Raise it.");
  EXPECT_NO_THROW(requireMemory({35, {4000, 3000}, CV_8UC3}, {}, {}, 8000.0, ""));
  EXPECT_NO_THROW(requireMemory({289, {1818, 1363}, CV_8UC3}, {}, {}, 8000.0, ""));
  EXPECT_THROW(requireMemory({36, {4000, 3000}, CV_8UC3}, {}, {}, 8000.0, ""), InputError);
}

TEST(MemoryNeed, SaysWhenNothingWouldFit)
{
  const auto refuse = [] { requireMemory({3, {512, 512}, CV_8UC3}, {}, {}, 10.0, "Raise it."); };
  EXPECT_NE(testing::messageOf<InputError>(refuse).find("no light field would fit. Raise it."),
            std::string::npos);
}

TEST(MemoryNeed, IsLimitedByTheMachineUnlessSomethingIsSaid)
{
  EXPECT_GT(machineMemoryMb(), 100.0);
  EXPECT_THROW(requireMemory({1000, {60000, 60000}, CV_8UC3}, {}, {}, 0.0, ""), InputError);
  EXPECT_NO_THROW(requireMemory({2, {16, 16}, CV_8UC3}, {}, {}, 0.0, ""));
}

}  // namespace
}  // namespace light_field_depth
