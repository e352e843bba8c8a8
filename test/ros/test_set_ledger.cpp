#include "ros/set_ledger.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace light_field_depth
{
namespace
{
const std::vector<bool> BOTH = {true, true};
const SetLedger::Time START;

/// Publishes what is ready. @return what was published since the last call
class Published
{
public:
  SetLedger::Publication note(const std::string& text)
  {
    return [this, text] { text_ += text; };
  }

  std::string takeFrom(SetLedger& ledger)
  {
    for (const SetLedger::Publication& publish : ledger.takeReady())
    {
      publish();
    }
    return std::exchange(text_, "");
  }

private:
  std::string text_;
};

TEST(SetLedger, ResultsAreInTheOrderOfTheStampsWhoeverIsFaster)
{
  SetLedger ledger(2);
  Published published;
  EXPECT_EQ(ledger.idleWorker(BOTH), 0U);
  ledger.give(0, 10, {"disparity", "stats"}, START);
  EXPECT_EQ(ledger.idleWorker(BOTH), 1U);
  ledger.give(1, 20, {"disparity", "stats"}, START);
  EXPECT_FALSE(ledger.idleWorker(BOTH));
  ledger.add(1, 20, "stats", published.note("c"));
  ledger.add(1, 20, "disparity", published.note("d"));
  EXPECT_EQ(published.takeFrom(ledger), "") << "the first set is still awaited";
  EXPECT_EQ(ledger.idleWorker(BOTH), 1U) << "but its worker is free";
  ledger.add(0, 10, "disparity", published.note("a"));
  EXPECT_EQ(published.takeFrom(ledger), "");
  ledger.add(0, 10, "stats", published.note("b"));
  EXPECT_EQ(published.takeFrom(ledger), "abcd");
  EXPECT_EQ(ledger.idleWorker(BOTH), 0U) << "the one that has waited longer";
}

TEST(SetLedger, AWorkerThatDiesCostsItsSetAlone)
{
  SetLedger ledger(2);
  Published published;
  ledger.give(0, 10, {"stats"}, START);
  ledger.give(1, 20, {"stats"}, START);
  ledger.add(1, 20, "stats", published.note("b"));
  EXPECT_TRUE(ledger.giveUp(BOTH, std::chrono::seconds(10), START + std::chrono::seconds(9)).empty());
  const auto lost = ledger.giveUp({false, true}, std::chrono::seconds(10), START);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].worker, 0U);
  EXPECT_EQ(lost[0].stamp_ns, 10);
  EXPECT_EQ(published.takeFrom(ledger), "b");
  EXPECT_EQ(ledger.idleWorker({false, true}), 1U);
  EXPECT_EQ(ledger.idleWorker(BOTH), 0U) << "it is back";
  ledger.add(0, 10, "stats", published.note("a"));
  EXPECT_EQ(published.takeFrom(ledger), "") << "too late";
}

TEST(SetLedger, AResultThatIsLeftOutIsNotAwaitedForLong)
{
  SetLedger ledger(1);
  Published published;
  ledger.give(0, 10, {"points_dense", "stats"}, START);
  ledger.add(0, 10, "stats", published.note("s"));
  ledger.finish(0, 10, std::chrono::seconds(1), START);
  EXPECT_TRUE(
      ledger.giveUp({true}, std::chrono::seconds(10), START + std::chrono::milliseconds(900)).empty());
  EXPECT_EQ(published.takeFrom(ledger), "");
  EXPECT_TRUE(
      ledger.giveUp({true}, std::chrono::seconds(10), START + std::chrono::milliseconds(1100)).empty());
  EXPECT_EQ(published.takeFrom(ledger), "s");
  EXPECT_EQ(ledger.idleWorker({true}), 0U);
}

TEST(SetLedger, ASilentWorkerIsGivenUpAfterAWhile)
{
  SetLedger ledger(1);
  ledger.give(0, 10, {"stats"}, START);
  EXPECT_EQ(ledger.giveUp({true}, std::chrono::seconds(10), START + std::chrono::seconds(11)).size(), 1U);
  EXPECT_EQ(ledger.idleWorker({true}), 0U);
}

}  // namespace
}  // namespace light_field_depth
