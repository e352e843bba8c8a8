#include "ros/view_synchronizer.h"

#include <algorithm>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
/// Which message a payload came from.
struct Message
{
  std::size_t view = 0;
  std::int64_t stamp_ns = 0;
};
using MessagePtr = std::shared_ptr<const Message>;
using Synchronizer = ViewSynchronizer<MessagePtr>;
using Sets = std::vector<Synchronizer::Set>;

Synchronizer makeSynchronizer(std::size_t views, std::int64_t tolerance_ns = 0, std::size_t queue_size = 5)
{
  ViewSynchronizerOptions options;
  options.view_count = views;
  options.tolerance_ns = tolerance_ns;
  options.queue_size = queue_size;
  return Synchronizer(options);
}

std::optional<Synchronizer::Set> add(Synchronizer& synchronizer, std::size_t view, std::int64_t stamp_ns)
{
  return synchronizer.add(view, stamp_ns, std::make_shared<Message>(Message{view, stamp_ns}));
}

/// Adds the messages in order and collects the whole sets.
Sets addAll(Synchronizer& synchronizer, const std::vector<Message>& messages)
{
  Sets sets;
  for (const Message& message : messages)
  {
    if (auto set = add(synchronizer, message.view, message.stamp_ns))
    {
      sets.push_back(std::move(*set));
    }
  }
  return sets;
}

/// Whether a set has one payload of every view, none farther from the earliest than the tolerance.
void expectWhole(const Synchronizer::Set& set, std::size_t views, std::int64_t tolerance_ns)
{
  ASSERT_EQ(set.payloads.size(), views);
  std::int64_t latest_ns = set.stamp_ns;
  for (std::size_t view = 0; view < views; ++view)
  {
    ASSERT_TRUE(set.payloads[view]);
    EXPECT_EQ(set.payloads[view]->view, view);
    EXPECT_GE(set.payloads[view]->stamp_ns, set.stamp_ns);
    EXPECT_LE(set.payloads[view]->stamp_ns, set.stamp_ns + tolerance_ns);
    latest_ns = std::max(latest_ns, set.payloads[view]->stamp_ns);
  }
  EXPECT_EQ(set.spread_ns, latest_ns - set.stamp_ns);
}

/// Frames 0, 1, ... of all views, stamps `period_ns` apart, in an order in which each view may run up to
/// `lead` frames ahead of another while its own messages stay in order.
std::vector<Message> interleaved(std::size_t views, int frames, std::int64_t period_ns, int lead,
                                 std::mt19937& random)
{
  std::vector<Message> messages;
  std::vector<int> next(views, 0);
  while (messages.size() < views * static_cast<std::size_t>(frames))
  {
    const int slowest = *std::min_element(next.begin(), next.end());
    const std::size_t view = random() % views;
    if (next[view] < std::min(frames, slowest + lead + 1))
    {
      messages.push_back({view, period_ns * next[view]++});
    }
  }
  return messages;
}

class ViewSynchronizerSizes : public ::testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Views, ViewSynchronizerSizes, ::testing::Values(1, 2, 9, 17, 81, 289));

class ViewSynchronizerDrops : public ::testing::TestWithParam<std::size_t>
{
};
INSTANTIATE_TEST_SUITE_P(Views, ViewSynchronizerDrops, ::testing::Values(2, 17, 81, 289));

TEST_P(ViewSynchronizerSizes, FindsEverySetInAnyInterleaving)
{
  constexpr int FRAMES = 12;
  constexpr std::int64_t PERIOD_NS = 100;
  std::mt19937 random(7);
  for (const std::int64_t tolerance_ns : {0, 10})
  {
    Synchronizer synchronizer = makeSynchronizer(GetParam(), tolerance_ns);
    std::vector<Message> messages = interleaved(GetParam(), FRAMES, PERIOD_NS, 3, random);
    for (Message& message : messages)
    {
      message.stamp_ns += static_cast<std::int64_t>(random() % static_cast<unsigned>(tolerance_ns + 1));
    }
    const Sets sets = addAll(synchronizer, messages);
    ASSERT_EQ(sets.size(), static_cast<std::size_t>(FRAMES));
    for (std::size_t i = 0; i < sets.size(); ++i)
    {
      expectWhole(sets[i], GetParam(), tolerance_ns);
      EXPECT_EQ(sets[i].stamp_ns / PERIOD_NS, static_cast<std::int64_t>(i));
    }
    EXPECT_EQ(synchronizer.statistics().sets_complete, static_cast<std::uint64_t>(FRAMES));
    EXPECT_EQ(synchronizer.statistics().sets_dropped, 0U);
  }
}

TEST_P(ViewSynchronizerDrops, CountsWhatItDropsByView)
{
  constexpr int FRAMES = 40;
  std::mt19937 random(3);
  std::vector<Message> messages = interleaved(GetParam(), FRAMES, 100, 2, random);
  std::vector<std::uint64_t> lost(GetParam(), 0);
  std::vector<bool> broken(FRAMES, false);
  for (int frame = 0; frame < FRAMES - 1; frame += 3)
  {
    const std::size_t view = random() % GetParam();
    ++lost[view];
    broken[static_cast<std::size_t>(frame)] = true;
    messages.erase(std::find_if(messages.begin(), messages.end(),
                                [&](const Message& message)
                                { return message.view == view && message.stamp_ns == 100 * frame; }));
  }
  messages.push_back({0, 100 * FRAMES});  // one more whole set, so that nothing is left open
  for (std::size_t view = 1; view < GetParam(); ++view)
  {
    messages.push_back({view, 100 * FRAMES});
  }
  Synchronizer synchronizer = makeSynchronizer(GetParam());
  const Sets sets = addAll(synchronizer, messages);
  const auto broken_count = static_cast<std::uint64_t>(std::count(broken.begin(), broken.end(), true));
  EXPECT_EQ(sets.size(), FRAMES + 1 - broken_count);
  EXPECT_EQ(synchronizer.statistics().sets_dropped, broken_count);
  for (std::size_t view = 0; view < GetParam(); ++view)
  {
    const ViewCounts& counts = synchronizer.statistics().views[view];
    EXPECT_EQ(counts.missing, lost[view]);
    EXPECT_EQ(counts.dropped, broken_count - lost[view]);
    EXPECT_EQ(counts.received, FRAMES + 1 - lost[view]);
  }
}

TEST_P(ViewSynchronizerSizes, GoesOnWhenABagLoops)
{
  constexpr int FRAMES = 3;
  std::mt19937 random(11);
  std::vector<Message> messages;
  for (int loop = 0; loop < 4; ++loop)
  {
    const std::vector<Message> once = interleaved(GetParam(), FRAMES, 100, 1, random);
    messages.insert(messages.end(), once.begin(), once.end());
  }
  Synchronizer synchronizer = makeSynchronizer(GetParam());
  const Sets sets = addAll(synchronizer, messages);
  EXPECT_EQ(sets.size(), 4U * FRAMES);
  EXPECT_EQ(synchronizer.statistics().time_jumps, 3U);
  EXPECT_EQ(synchronizer.statistics().sets_dropped, 0U);
}

TEST(ViewSynchronizer, GoesOnWhenViewsSeeTheJumpAtDifferentTimes)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  // View 0 begins the second loop while view 1 has yet to deliver the end of the first.
  const Sets sets = addAll(synchronizer, {{0, 100}, {1, 100}, {0, 200}, {0, 100}, {1, 200}, {1, 100}});
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[1].stamp_ns, 200);
  EXPECT_EQ(sets[2].stamp_ns, 100);
}

TEST(ViewSynchronizer, MixesNothingFromBeforeAJump)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  // View 1 of stamp 300 is lost before the jump, view 0 of stamp 300 after it.
  const Sets sets = addAll(synchronizer, {{0, 200}, {1, 200}, {0, 300}, {0, 100}, {1, 100}, {1, 300}});
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[1].stamp_ns, 100);
}

TEST(ViewSynchronizer, RepeatsABagOfOneFrame)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  EXPECT_EQ(addAll(synchronizer, {{0, 5}, {1, 5}, {0, 5}, {1, 5}, {1, 5}, {0, 5}}).size(), 3U);
}

TEST(ViewSynchronizer, DropsALateMessage)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  const Sets sets = addAll(synchronizer, {{0, 200}, {1, 200}, {1, 100}, {0, 300}, {1, 300}});
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[1].stamp_ns, 300);
  EXPECT_EQ(synchronizer.statistics().views[1].dropped, 1U);
  EXPECT_EQ(synchronizer.statistics().time_jumps, 0U);
}

TEST(ViewSynchronizer, ReplacesADuplicate)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  const auto first = std::make_shared<Message>(Message{0, 7});
  const auto second = std::make_shared<Message>(Message{0, 7});
  EXPECT_FALSE(synchronizer.add(0, 7, first));
  EXPECT_FALSE(synchronizer.add(0, 7, second));
  const auto set = add(synchronizer, 1, 7);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->payloads[0], second);
  EXPECT_EQ(synchronizer.statistics().views[0].dropped, 1U);
  EXPECT_EQ(first.use_count(), 1) << "a replaced message is let go";
}

TEST(ViewSynchronizer, TakesTheToleranceAsTheLargestDifference)
{
  Synchronizer at_boundary = makeSynchronizer(3, 10);
  EXPECT_EQ(addAll(at_boundary, {{0, 105}, {1, 100}, {2, 110}}).size(), 1U);
  Synchronizer beyond = makeSynchronizer(3, 10);
  EXPECT_EQ(addAll(beyond, {{0, 105}, {1, 100}, {2, 111}}).size(), 0U);
  Synchronizer exact = makeSynchronizer(2);
  EXPECT_EQ(addAll(exact, {{0, 100}, {1, 101}}).size(), 0U);
}

TEST(ViewSynchronizer, ChoosesTheNearestSetWithinTheTolerance)
{
  Synchronizer synchronizer = makeSynchronizer(2, 10);
  const Sets sets = addAll(synchronizer, {{0, 100}, {0, 112}, {1, 109}});
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].payloads[0]->stamp_ns, 112);
}

TEST(ViewSynchronizer, IsBoundedWhenAViewNeverComes)
{
  constexpr std::size_t QUEUE = 4;
  Synchronizer synchronizer = makeSynchronizer(2, 0, QUEUE);
  std::vector<std::weak_ptr<const Message>> sent;
  for (int i = 0; i < 100; ++i)
  {
    auto message = std::make_shared<const Message>(Message{0, i});
    sent.emplace_back(message);
    EXPECT_FALSE(synchronizer.add(0, i, std::move(message)));
  }
  const auto held =
      std::count_if(sent.begin(), sent.end(), [](const auto& message) { return !message.expired(); });
  EXPECT_EQ(held, static_cast<std::ptrdiff_t>(QUEUE));
  EXPECT_EQ(synchronizer.statistics().views[1].missing, 100U - QUEUE);
  EXPECT_EQ(synchronizer.statistics().views[1].received, 0U);
}

TEST(ViewSynchronizer, ForgetsOnReset)
{
  Synchronizer synchronizer = makeSynchronizer(2);
  EXPECT_FALSE(add(synchronizer, 0, 100));
  synchronizer.reset();
  EXPECT_FALSE(add(synchronizer, 1, 100));
  EXPECT_TRUE(add(synchronizer, 0, 100));
}

TEST(ViewSynchronizer, RefusesOptionsThatCannotBeUsed)
{
  EXPECT_THROW(makeSynchronizer(0), InputError);
  EXPECT_THROW(makeSynchronizer(2, -1), InputError);
  EXPECT_THROW(makeSynchronizer(2, 0, 0), InputError);
}

/// A synchroniser of three views that may do without the last one.
Synchronizer tolerantSynchronizer(bool allow_incomplete)
{
  ViewSynchronizerOptions options;
  options.view_count = 3;
  options.allow_incomplete = allow_incomplete;
  options.enough = [](const std::vector<bool>& present) { return present[0] && present[1]; };
  return Synchronizer(options);
}

TEST(ViewSynchronizerPartialSets, AreUsedWithoutASilentView)
{
  Synchronizer synchronizer = tolerantSynchronizer(false);
  add(synchronizer, 0, 100);
  EXPECT_FALSE(add(synchronizer, 1, 100));
  synchronizer.setSilent(2);
  const auto waiting = synchronizer.next();
  ASSERT_TRUE(waiting) << "what waited is used at once";
  EXPECT_FALSE(waiting->payloads[2]);
  add(synchronizer, 0, 200);
  EXPECT_TRUE(add(synchronizer, 1, 200));
  EXPECT_EQ(synchronizer.statistics().sets_partial, 2U);
  EXPECT_EQ(synchronizer.statistics().views[2].missing, 2U);

  EXPECT_FALSE(add(synchronizer, 2, 300)) << "it is back";
  add(synchronizer, 0, 300);
  const auto whole = add(synchronizer, 1, 300);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->payloads[2]);
  add(synchronizer, 0, 400);
  EXPECT_FALSE(add(synchronizer, 1, 400)) << "and waited for";
}

TEST(ViewSynchronizerPartialSets, NeedEnoughViews)
{
  Synchronizer synchronizer = tolerantSynchronizer(true);
  synchronizer.setSilent(1);
  add(synchronizer, 0, 100);
  EXPECT_FALSE(add(synchronizer, 2, 100));
  add(synchronizer, 0, 200);
  EXPECT_FALSE(add(synchronizer, 2, 200));
}

TEST(ViewSynchronizerPartialSets, LackASingleImageOnceItsViewHasGoneOn)
{
  for (const bool allow_incomplete : {false, true})
  {
    Synchronizer synchronizer = tolerantSynchronizer(allow_incomplete);
    add(synchronizer, 0, 100);
    add(synchronizer, 1, 100);
    add(synchronizer, 0, 200);
    const auto first = add(synchronizer, 2, 200);
    EXPECT_EQ(first.has_value(), allow_incomplete);
    EXPECT_TRUE(add(synchronizer, 1, 200));
    EXPECT_EQ(synchronizer.statistics().sets_partial, allow_incomplete ? 1U : 0U);
    EXPECT_EQ(synchronizer.statistics().sets_dropped, allow_incomplete ? 0U : 1U);
  }
}

TEST(ViewSynchronizerLateMessages, AreCountedWithHowLateTheyAre)
{
  Synchronizer synchronizer = makeSynchronizer(2, 0, 3);
  for (std::int64_t frame = 1; frame <= 20; ++frame)
  {
    add(synchronizer, 0, 100 * frame);
    if (frame > 6)
    {
      EXPECT_FALSE(add(synchronizer, 1, 100 * (frame - 6)));
    }
  }
  const ViewCounts& late = synchronizer.statistics().views[1];
  EXPECT_EQ(late.late, 14U);
  EXPECT_EQ(late.late_by_sets, 7U) << "a queue of more sets holds them";
  EXPECT_EQ(synchronizer.statistics().views[0].late, 0U);

  Synchronizer longer = makeSynchronizer(2, 0, 7);
  std::size_t sets = 0;
  for (std::int64_t frame = 1; frame <= 20; ++frame)
  {
    add(longer, 0, 100 * frame);
    sets += frame > 6 && add(longer, 1, 100 * (frame - 6)) ? 1 : 0;
  }
  EXPECT_EQ(sets, 14U);
}

TEST(ViewSynchronizerLateMessages, AreForgottenWhenTimeJumpsBack)
{
  Synchronizer synchronizer = makeSynchronizer(2, 0, 1);
  add(synchronizer, 0, 100);
  add(synchronizer, 0, 200);  // drops the set of 100
  add(synchronizer, 1, 200);
  add(synchronizer, 0, 100);
  EXPECT_TRUE(add(synchronizer, 1, 100)) << "the bag begins anew";
}

}  // namespace
}  // namespace light_field_depth
