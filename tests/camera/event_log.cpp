#include "event_log.h"

#include "core/error.h"

namespace onestroke::usb {

EventLog::EventLog(const std::filesystem::path& file) : out_(file) {
  if (!out_)
    throw Error(file.string() + " cannot be written; check that its folder exists and that you may write there");
}

void EventLog::add(const char* event, Time time, const nlohmann::json& more) {
  nlohmann::ordered_json line{{"event", event}, {"time_ns", time.ns}};
  line.update(more);
  out_ << line.dump() << '\n' << std::flush;
}

}  // namespace onestroke::usb
