// panache view: the page, served to this machine alone.

#include <csignal>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "cli/program.h"

namespace panache::test {
namespace {

// The program in a folder of its own, with a page beside it.
class ViewVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (run({"view", "--help"}).out.find("not in this build") != std::string::npos) {
      GTEST_SKIP() << "this build has no server for the page";
    }
    program_ = path("bin/panache");
    std::filesystem::create_directory(path("bin"));
    std::filesystem::copy_file(PANACHE_PROGRAM, program_);
    write_walk("walk one.bvh");
  }
  void TearDown() override {
    if (server_ > 0) {
      ::kill(server_, SIGTERM);
      ::waitpid(server_, nullptr, 0);
    }
    ProgramTest::TearDown();
  }

  // Starts it; the first line that it says.
  std::string serve(const std::string& file, const std::string& model) {
    int ends[2];
    if (::pipe(ends) != 0) return "";
    server_ = ::fork();
    if (server_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      ::execl(program_.c_str(), "panache", "view", path(file).c_str(), "--model",
              path(model).c_str(), nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    std::string line;
    for (char c; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(ends[0]);
    return line;
  }

  // The whole answer to a GET of `target`.
  static std::string get(int port, const std::string& target, const std::string& host) {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string answer;
    if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      const std::string question =
          "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
      EXPECT_EQ(::send(socket, question.data(), question.size(), 0),
                static_cast<ssize_t>(question.size()));
      char block[4096];
      for (ssize_t n; (n = ::recv(socket, block, sizeof block, 0)) > 0;) {
        answer.append(block, static_cast<size_t>(n));
      }
    }
    ::close(socket);
    return answer;
  }
  static std::string status(const std::string& answer) { return answer.substr(0, 12); }

  std::string program_;
  pid_t server_ = 0;
};

TEST_F(ViewVerb, explains_a_missing_page_and_a_damaged_file) {
  Ran ran = run({"view"}, "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err, "panache: the page was not found; searched " + path("share/panache/web") +
                         ", " + path("web") + "; ./run web makes it\n");
  write("damaged.bvh", "HIERARCHY\nROTO hips");
  ran = run({"view", "damaged.bvh"}, "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err.substr(0, 26), "panache: damaged.bvh:2:1: ");
  write("damaged.safetensors", "no model");
  ran = run({"view", "--model", "damaged.safetensors"}, "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(ran.err.starts_with("panache: damaged.safetensors: ")) << ran.err;
}

TEST_F(ViewVerb, serves_page_and_file_and_nothing_else_under_no_name_but_its_own) {
  write("web/index.html", "the page");
  std::filesystem::copy_file(path("model.safetensors"), path("my model.safetensors"));
  const std::string line = serve("walk one.bvh", "my model.safetensors");
  const std::string begin = "http://127.0.0.1:",
                    end = "/?open=walk%20one.bvh&model=my%20model.safetensors";
  ASSERT_TRUE(line.starts_with(begin) && line.ends_with(end)) << line;
  const std::string digits = line.substr(begin.size(), line.size() - begin.size() - end.size());
  const int port = std::stoi(digits);
  const std::string host = "127.0.0.1:" + digits;

  const std::string page = get(port, "/", host);
  EXPECT_EQ(status(page), "HTTP/1.1 200");
  EXPECT_TRUE(page.ends_with("the page"));
  const std::string file = get(port, "/open/walk%20one.bvh", host);
  EXPECT_EQ(status(file), "HTTP/1.1 200");
  EXPECT_TRUE(file.ends_with(read("walk one.bvh")));
  const std::string model = get(port, "/model/my%20model.safetensors", host);
  EXPECT_EQ(status(model), "HTTP/1.1 200");
  EXPECT_TRUE(model.ends_with(read("my model.safetensors")));

  EXPECT_EQ(status(get(port, "/../model.safetensors", host)), "HTTP/1.1 404");
  EXPECT_EQ(status(get(port, "/%2e%2e/model.safetensors", host)), "HTTP/1.1 404");
  EXPECT_EQ(status(get(port, "/", "example.org")), "HTTP/1.1 403");
}

}  // namespace
}  // namespace panache::test
