// panache view: the page, served to this machine alone.

#include <cerrno>
#include <csignal>
#include <functional>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "cli/program.h"

#ifdef PANACHE_SECCOMP
#include <seccomp.h>
#endif

namespace panache::test {
namespace {

// The program in a folder of its own, with a page beside it.
class ViewVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (run("view --help").out.find("not in this build") != std::string::npos) {
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
  std::string serve(const std::string& file, const std::string& model, bool no_open = true) {
    int ends[2];
    if (::pipe(ends) != 0) return "";
    server_ = ::fork();
    if (server_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      ::execl(program_.c_str(), "panache", "view", path(file).c_str(), "--model",
              path(model).c_str(), no_open ? "--no-open" : nullptr, nullptr);
      ::_exit(127);
    }
    ::close(ends[1]);
    std::string line;
    for (char c; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(ends[0]);
    return line;
  }

  // The whole answer to a request, which names the server as its host unless `headers` do.
  std::string get(const std::string& target, const std::string& headers = "",
                  const std::string& method = "GET") const {
    const bool has_host = headers.starts_with("Host:") || headers == kNoHost;
    return ask(port_, method + " " + target + " HTTP/1.1\r\n" +
                          (has_host ? "" : "Host: " + host() + "\r\n") +
                          (headers == kNoHost ? "" : headers) + "Connection: close\r\n\r\n");
  }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  // The whole answer to `question`; empty where nobody listens.
  static std::string ask(int port, const std::string& question, const char* at = "127.0.0.1") {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    ::inet_pton(AF_INET, at, &address.sin_addr);
    std::string answer;
    if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      EXPECT_EQ(::send(socket, question.data(), question.size(), MSG_NOSIGNAL),
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

  // Starts it with "web/index.html" as its page.
  void serve_page() {
    write("web/index.html", "the page");
    const std::string line = serve("walk one.bvh", "model.safetensors");
    const std::string begin = "http://127.0.0.1:";
    if (line.starts_with(begin)) port_ = std::atoi(line.c_str() + begin.size());
    ASSERT_GT(port_, 0) << line;
  }

  static constexpr const char* kNoHost = "no host";
  int port_ = 0;
  std::string program_;
  pid_t server_ = 0;
};

TEST_F(ViewVerb, explains_a_missing_page_and_a_damaged_file) {
  Ran ran = run("view", "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err, "panache: the page was not found; searched " + path("share/panache/web") +
                         ", " + path("web") + "; ./run web makes it\n");
  write("damaged.bvh", "HIERARCHY\nROTO hips");
  ran = run("view damaged.bvh", "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err.substr(0, 26), "panache: damaged.bvh:2:1: ");
  write("damaged.safetensors", "no model");
  ran = run("view --model damaged.safetensors", "model.safetensors", program_);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err, "panache: damaged.safetensors: "));
}

TEST_F(ViewVerb, serves_page_file_and_model_and_nothing_else) {
  write("web/index.html", "the page");
  std::filesystem::copy_file(path("model.safetensors"), path("my model.safetensors"));
  const std::string line = serve("walk one.bvh", "my model.safetensors");
  const std::string begin = "http://127.0.0.1:",
                    end = "/?open=walk%20one.bvh&model=my%20model.safetensors";
  ASSERT_TRUE(line.starts_with(begin) && line.ends_with(end)) << line;
  port_ = std::stoi(line.substr(begin.size()));
  const std::pair<const char*, std::string> served[] = {
      {"/", "the page"},
      {"/open/walk%20one.bvh", read("walk one.bvh")},
      {"/model/my%20model.safetensors", read("my model.safetensors")}};
  for (const auto& [target, content] : served) {
    const std::string answer = get(target);
    EXPECT_EQ(status(answer), "HTTP/1.1 200") << target;
    EXPECT_TRUE(answer.ends_with("\r\n\r\n" + content)) << target;
  }
  EXPECT_EQ(status(get("/../model.safetensors")), "HTTP/1.1 404");
  EXPECT_EQ(status(get("/%2e%2e/model.safetensors")), "HTTP/1.1 404");
}

TEST_F(ViewVerb, listens_on_the_loopback_address_only) {
  serve_page();
  // Linux takes all of 127.0.0.0/8 for this machine: who listens on every address answers here too.
  const std::string question =
      "GET / HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n\r\n";
  EXPECT_EQ(status(ask(port_, question)), "HTTP/1.1 200");
  EXPECT_EQ(ask(port_, question, "127.0.0.2"), "");
}

TEST_F(ViewVerb, serves_its_own_files_only_however_the_path_is_written) {
  write("secret.txt", "secret");
  write("web/secrets/in.txt", "in the page's folder");
  std::filesystem::create_directory(path("webbed"));
  write("webbed/secret.txt", "secret");
  serve_page();
  EXPECT_EQ(status(get("/secrets/in.txt")), "HTTP/1.1 200");
  const std::string outside = path("secret.txt");
  const std::string targets[] = {"/../secret.txt",
                                 "/secrets/../../secret.txt",
                                 "/%2e%2e/secret.txt",
                                 "/..%2fsecret.txt",
                                 "/%2e%2e%2fsecret.txt",
                                 "/..%5csecret.txt",
                                 "/..\\secret.txt",
                                 "/%252e%252e/secret.txt",
                                 "//secret.txt",
                                 "/./../secret.txt",
                                 "/../webbed/secret.txt",
                                 "/%00/../secret.txt",
                                 "/secrets/%2e%2e/%2e%2e/secret.txt",
                                 "/%c0%ae%c0%ae/secret.txt",
                                 "secret.txt",
                                 "../secret.txt",
                                 outside,
                                 "http://" + host() + outside};
  for (const std::string& target : targets) {
    const std::string answer = get(target);
    EXPECT_NE(status(answer), "HTTP/1.1 200") << target;
    EXPECT_FALSE(answer.ends_with("secret")) << target;
  }
}

TEST_F(ViewVerb, rejects_other_hosts_other_origins_and_whatever_is_not_read) {
  serve_page();
  // '@' is the port.
  const auto answer = [&](std::string headers, const std::string& method = "GET") {
    for (size_t at; (at = headers.find('@')) != headers.npos;) {
      headers.replace(at, 1, std::to_string(port_));
    }
    return status(get("/", headers, method));
  };
  for (const char* own : {"", "Host: localhost:@\r\n", "Origin: http://127.0.0.1:@\r\n"}) {
    EXPECT_EQ(answer(own), "HTTP/1.1 200") << own;
  }
  for (const char* other :
       {kNoHost, "Host: \r\n", "Host: 127.0.0.1\r\n", "Host: 127.0.0.1:1\r\n",
        "Host: 127.0.0.2:@\r\n", "Host: 127.0.0.1:@.example.org\r\n", "Host: example.org\r\n",
        "Host: 127.0.0.1:@\r\nHost: example.org\r\n", "Origin: null\r\n",
        "Origin: http://example.org\r\n", "Origin: https://127.0.0.1:@\r\n",
        "Origin: http://127.0.0.1\r\n", "Origin: 127.0.0.1:@\r\n",
        "Origin: http://127.0.0.1:@.example.org\r\n", "Origin: http://example.org:@\r\n"}) {
    EXPECT_EQ(answer(other), "HTTP/1.1 403") << other;
  }
  for (const char* method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
    EXPECT_EQ(answer("Content-Length: 0\r\n", method), "HTTP/1.1 405") << method;
  }
  // A body that is a request itself is not answered.
  const std::string own = "Host: " + host() + "\r\n", inner = "GET / HTTP/1.1\r\n" + own + "\r\n";
  const std::string twice =
      ask(port_, "POST / HTTP/1.1\r\n" + own + "Content-Length: " + std::to_string(inner.size()) +
                     "\r\n\r\n" + inner);
  EXPECT_EQ(status(twice), "HTTP/1.1 405");
  EXPECT_FALSE(holds(twice, "the page"));
}

// The value of a header, without quotes or the end of the line.
std::string header(const std::string& answer, const std::string& name) {
  const size_t at = answer.find("\r\n" + name + ": ");
  if (at == answer.npos) return "";
  const size_t begin = at + name.size() + 4;
  return answer.substr(begin, answer.find("\r\n", begin) - begin);
}

TEST_F(ViewVerb, sends_what_is_stored_compressed_and_nothing_that_the_browser_has) {
  write("web/main.js", "let plain;");
  write("web/main.js.br", "as stored");
  write("web/alone.js.br", "without an original");
  serve_page();
  for (const std::string wanted : {"gzip, deflate, br", "br,gzip", "br;q=0.5"}) {
    const std::string packed = get("/main.js", "Accept-Encoding: " + wanted + "\r\n");
    EXPECT_TRUE(packed.ends_with("\r\n\r\nas stored")) << packed;
    EXPECT_EQ(header(packed, "Content-Encoding"), "br");
    EXPECT_EQ(header(packed, "Vary"), "Accept-Encoding");
    EXPECT_EQ(header(packed, "Content-Type"), "text/javascript; charset=utf-8");
  }
  for (const std::string wanted :
       {"", "Accept-Encoding: gzip\r\n", "Accept-Encoding: br;q=0\r\n"}) {
    const std::string plain = get("/main.js", wanted);
    EXPECT_TRUE(plain.ends_with("\r\n\r\nlet plain;")) << plain;
    EXPECT_EQ(header(plain, "Content-Encoding"), "");
  }
  EXPECT_EQ(status(get("/main.js.br")), "HTTP/1.1 404");
  EXPECT_EQ(status(get("/alone.js", "Accept-Encoding: br\r\n")), "HTTP/1.1 404");

  const std::string accepts = "Accept-Encoding: br\r\n";
  const std::string tag = header(get("/main.js", accepts), "ETag");
  const std::string plain_tag = header(get("/main.js"), "ETag");
  EXPECT_EQ(tag.size(), 18u);
  EXPECT_NE(tag, plain_tag);
  EXPECT_NE(tag, header(get("/"), "ETag"));
  for (const std::string& known : {tag, "W/" + tag, "\"other\", " + tag}) {
    const std::string same = get("/main.js", accepts + "If-None-Match: " + known + "\r\n");
    EXPECT_EQ(status(same), "HTTP/1.1 304") << known;
    EXPECT_TRUE(same.ends_with("\r\n\r\n")) << same;
    EXPECT_EQ(header(same, "ETag"), tag);
  }
  for (const std::string& other : {std::string("\"other\""), plain_tag}) {
    EXPECT_EQ(status(get("/main.js", accepts + "If-None-Match: " + other + "\r\n")),
              "HTTP/1.1 200");
  }
}

TEST_F(ViewVerb, opens_the_browser_of_a_desktop_unless_told_not_to) {
  write("web/index.html", "the page");
  write("bin/xdg-open", "#!/bin/sh\necho \"$1\" >" + path("opened") + "\n");
  std::filesystem::permissions(path("bin/xdg-open"), std::filesystem::perms::owner_all);
  const auto opened = [&](const char* display, bool no_open) {
    std::filesystem::remove(path("opened"));
    ::setenv("PATH", (path("bin") + ":/usr/bin:/bin").c_str(), 1);
    display ? ::setenv("DISPLAY", display, 1) : ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    const std::string line = serve("walk one.bvh", "model.safetensors", no_open);
    for (int i = 0; i < 100 && !std::filesystem::exists(path("opened")); ++i) ::usleep(10'000);
    ::usleep(50'000);
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
    server_ = 0;
    const bool there = std::filesystem::exists(path("opened"));
    if (there) {
      EXPECT_EQ(read("opened"), line + "\n");
    }
    return there;
  };
  EXPECT_TRUE(opened(":0", false));
  EXPECT_FALSE(opened(":0", true));
  EXPECT_FALSE(opened(nullptr, false));
}

TEST_F(ViewVerb, keeps_pages_of_others_from_showing_or_reading_it) {
  serve_page();
  const std::string answer = get("/");
  for (const std::string header :
       {"Cross-Origin-Resource-Policy: same-origin\r\n", "X-Content-Type-Options: nosniff\r\n",
        "frame-ancestors 'none'"}) {
    EXPECT_TRUE(holds(answer, header)) << header;
  }
  EXPECT_FALSE(holds(answer, "Access-Control-Allow-Origin"));
  EXPECT_FALSE(holds(answer, " 'unsafe-eval'"));
}

#if defined(PANACHE_SECCOMP) && !defined(PANACHE_SANITIZED)  // Not under the sanitizers.
// Runs `start` where `call` fails with `error`; its exit code is that of the process it starts.
pid_t start_where_fails(int call, int error, const std::function<pid_t()>& start) {
  const pid_t watcher = ::fork();
  if (watcher != 0) return watcher;
  scmp_filter_ctx rules = ::seccomp_init(SCMP_ACT_ALLOW);
  int status = 0;
  if (rules && ::seccomp_rule_add(rules, SCMP_ACT_ERRNO(error), call, 0) == 0 &&
      ::seccomp_load(rules) == 0) {
    ::waitpid(start(), &status, 0);
    ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 99);
  }
  ::_exit(77);
}

TEST_F(ViewVerb, fails_with_the_reason_where_it_cannot_listen) {
  write("web/index.html", "the page");
  const std::string no_port = "panache: 127.0.0.1: no port to serve the page on: ",
                    hint = "; is the loopback interface up, and may programs listen on it?\n";
  const struct {
    int call, error;
    std::string begin, end;
  } cases[] = {
      {SCMP_SYS(socket), EMFILE, no_port, "Too many open files" + hint},
      {SCMP_SYS(bind), EADDRINUSE, no_port, "Address already in use" + hint},
      {SCMP_SYS(listen), EADDRINUSE, no_port, "Address already in use" + hint},
      {SCMP_SYS(accept), EPERM,
       "panache: open this address in a browser; Ctrl-C ends\npanache: 127.0.0.1:",
       ": listening failed, so the page is not served any more\n"},
  };
  for (const auto& [call, error, begin, end] : cases) {
    const Ran ran = finish(start_where_fails(call, error, [&] {
      return start({"view", "walk one.bvh", "--no-open"}, "model.safetensors", program_);
    }));
    if (ran.exit == 77) GTEST_SKIP() << "this kernel has no filters";
    EXPECT_EQ(ran.exit, 1) << call;
    EXPECT_TRUE(ran.err.starts_with(begin) && ran.err.ends_with(end)) << ran.err;
  }
}
#endif

}  // namespace
}  // namespace panache::test
