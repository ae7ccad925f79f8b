#include "harness/history.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "error.h"

namespace pbdcheck {
namespace {

class Appended {
 public:
  explicit Appended(const std::filesystem::path& path)
      : path_(path.string()), file_(open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666)) {
    if (file_ < 0) refuse();
  }
  ~Appended() { close(file_); }
  Appended(const Appended&) = delete;
  Appended& operator=(const Appended&) = delete;

  bool ends_within_a_line() {
    char last = '\n';
    const auto size = lseek(file_, 0, SEEK_END);
    if (size > 0 && pread(file_, &last, 1, size - 1) != 1) refuse();
    return last != '\n';
  }

  void write_once(const std::string& text) {
    if (write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) refuse();
  }

 private:
  [[noreturn]] void refuse() const {
    throw pbd::SetupError(path_, std::strerror(errno), "a file that can be read and appended to");
  }

  std::string path_;
  int file_;
};

}  // namespace

nlohmann::ordered_json history_entry(std::string_view status, double seconds, const TableTotals& totals,
                                     const std::vector<Verdict>& verdicts) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& v : verdicts)
    list.push_back({{"id", v.id},
                    {"class", basis_names[static_cast<std::size_t>(v.basis)]},
                    {"measured", v.measured.value},
                    {"bound", v.bound},
                    {"verdict", ruling_names[static_cast<std::size_t>(v.ruling())]}});
  return {{"status", status}, {"run_s", seconds}, {"work", totals.work}, {"verdicts", std::move(list)}};
}

void append_history(const std::filesystem::path& path, const nlohmann::ordered_json& record) {
  Appended file(path);
  file.write_once((file.ends_within_a_line() ? "\n" : "") + record.dump() + '\n');
}

}  // namespace pbdcheck
