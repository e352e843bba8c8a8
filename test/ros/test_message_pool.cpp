#include "ros/message_pool.h"

#include <optional>

#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>

namespace light_field_depth
{
namespace
{
using Pool = MessagePool<sensor_msgs::PointCloud2>;
constexpr std::size_t BYTES = 100000;

TEST(MessagePool, GivesMemoryAgainOnceNobodyHoldsIt)
{
  Pool pool;
  auto message = pool.take();
  message->data.resize(BYTES);
  const auto* const memory = message->data.data();
  const boost::shared_ptr<const sensor_msgs::PointCloud2> subscriber = message;
  message.reset();
  EXPECT_NE(pool.take()->data.data(), memory) << "a subscriber still has it";
  EXPECT_EQ(subscriber->data.size(), BYTES);
}

TEST(MessagePool, UsesMemoryAgain)
{
  Pool pool;
  auto message = pool.take();
  message->data.resize(BYTES);
  const auto* const memory = message->data.data();
  message.reset();
  EXPECT_EQ(pool.take()->data.data(), memory);
}

TEST(MessagePool, MayEndBeforeItsMessages)
{
  std::optional<Pool> pool(std::in_place);
  const auto message = pool->take();
  message->data.resize(BYTES);
  pool.reset();
  EXPECT_EQ(message->data.size(), BYTES);
}

}  // namespace
}  // namespace light_field_depth
