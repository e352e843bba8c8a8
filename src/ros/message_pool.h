#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_MESSAGE_POOL_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_MESSAGE_POOL_H

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <boost/shared_ptr.hpp>

namespace light_field_depth
{
/// Large messages of one type, whose memory is used again once everybody has let go of them: fresh memory of
/// many megabytes costs more time than what is written into it. Thread safe; messages may outlive the pool.
template <class Message>
class MessagePool
{
public:
  /// A message with whatever it held before; no other holder of it is left.
  boost::shared_ptr<Message> take()
  {
    std::unique_ptr<Message> message = spares_->take();
    if (message == nullptr)
    {
      message = std::make_unique<Message>();
    }
    const std::weak_ptr<Spares> spares = spares_;
    return boost::shared_ptr<Message>(message.release(),
                                      [spares](Message* returned)
                                      {
                                        std::unique_ptr<Message> owned(returned);
                                        if (const std::shared_ptr<Spares> alive = spares.lock())
                                        {
                                          alive->put(std::move(owned));
                                        }
                                      });
  }

private:
  /// One is being written, one is being published.
  static constexpr std::size_t MAX_SPARES = 2;

  class Spares
  {
  public:
    std::unique_ptr<Message> take()
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (messages_.empty())
      {
        return nullptr;
      }
      std::unique_ptr<Message> message = std::move(messages_.back());
      messages_.pop_back();
      return message;
    }

    void put(std::unique_ptr<Message> message)
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (messages_.size() < MAX_SPARES)
      {
        messages_.push_back(std::move(message));
      }
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Message>> messages_;
  };

  std::shared_ptr<Spares> spares_ = std::make_shared<Spares>();
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_MESSAGE_POOL_H
