// SPDX-License-Identifier: BSD-2-Clause
#include "display/page_server.h"

#include <stdexcept>

#ifdef PBRT_MEDIA_HAS_HTTPLIB
#include <httplib.h>
#include <pthread.h>

#include <cerrno>
#include <cstring>
#include <random>

#include "base/stopwatch.h"
#include "display/host_header.h"
#include "display/page.h"
#include "display/page_data.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kThreads = 4;      ///< requests that are answered at one time
constexpr std::size_t kChunk = 1 << 18;  ///< bytes of an image that are written at a time
constexpr std::size_t kMostBody = 1024;  ///< bytes of a request
constexpr double kWanted = 5;            ///< seconds for which a request wants images: pages ask more often
constexpr double kWatching = 3;          ///< seconds after a request for which somebody is taken to look on
constexpr int kPatience = 2;  ///< seconds for which a connection may rest in the middle of a message

std::string randomDigits() {
  std::random_device random;
  std::string digits;
  for (int i = 0; i < 32; ++i) digits += "0123456789abcdef"[random() % 16];
  return digits;
}

/// Takes the same time for all wrong tokens of a length.
bool isSame(const std::string& a, const std::string& b) {
  unsigned char differing = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    differing |= static_cast<unsigned char>(a[i] ^ b[i]);
  return differing == 0;
}

std::string pageWithNonce(const std::string& nonce) {
  constexpr std::string_view kPlace = "@NONCE@";
  std::string page;
  std::string_view rest = kPage;
  for (std::size_t at = rest.find(kPlace); at != rest.npos; at = rest.find(kPlace)) {
    page.append(rest.substr(0, at)).append(nonce);
    rest.remove_prefix(at + kPlace.size());
  }
  return page.append(rest);
}

}  // namespace

class PageServer::Server {
 public:
  Server(Feed& feed, const Params& params, std::function<void()> stop)
      : feed_(feed), params_(params), stop_(std::move(stop)), token_(randomDigits()) {
    configure();
    route();
    bind();
    feed_.update([](RenderStatus& status) { status.run = randomDigits(); });
    thread_ = std::thread([this] {
      http_.listen_after_bind();
      isOver_ = true;
    });
    ::pthread_setname_np(thread_.native_handle(), "serve");
    // Told to stop before it runs, it would run for ever.
    while (!http_.is_running() && !isOver_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  ~Server() {
    sayFarewell();
    isEnding_ = true;
    http_.stop();
    thread_.join();
  }

  const Endpoint& at() const { return params_.at; }
  const std::string& token() const { return token_; }

 private:
  void configure() {
    http_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // A browser keeps connections open, and each would keep a thread.
    http_.set_keep_alive_max_count(1);
    http_.set_keep_alive_timeout(kPatience);
    http_.set_read_timeout(kPatience);
    http_.set_write_timeout(kPatience);
    http_.set_payload_max_length(kMostBody);
    http_.set_tcp_nodelay(true);
    // Not the library's choice, which lets two servers share a port.
    http_.set_socket_options([](socket_t socket) {
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    http_.set_default_headers({{"Cache-Control", "no-store"},
                               {"X-Content-Type-Options", "nosniff"},
                               {"X-Frame-Options", "DENY"},
                               {"Referrer-Policy", "no-referrer"},
                               {"Cross-Origin-Resource-Policy", "same-origin"}});
    http_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (isOwnHost(request.get_header_value("Host"), params_.at.host))
        return httplib::Server::HandlerResponse::Unhandled;
      refuse(response, 403, "this server answers to its address only, not to the name in the Host header\n");
      return httplib::Server::HandlerResponse::Handled;
    });
    http_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) {
        refuse(response, response.status, "nothing here; known: GET /, /status, /image, POST /stop\n");
      }
    });
  }

  void route() {
    http_.Get("/", [](const httplib::Request&, httplib::Response& response) {
      const std::string nonce = randomDigits();
      response.set_header("Content-Security-Policy",
                          "default-src 'none'; script-src 'nonce-" + nonce + "'; style-src 'nonce-" + nonce +
                              "'; img-src data:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
                              "frame-ancestors 'none'");
      response.set_content(pageWithNonce(nonce), "text/html; charset=utf-8");
    });
    http_.Get("/status", [this](const httplib::Request&, httplib::Response& response) {
      const bool isLast = feed_.isClosed();
      response.set_content(statusText(feed_.status()), "application/json");
      noteRequest();
      if (isLast) lastStatusServed_ = true;
    });
    http_.Get("/image", [this](const httplib::Request& request, httplib::Response& response) {
      image(request, response);
    });
    http_.Post("/stop", [this](const httplib::Request& request, httplib::Response& response) {
      stop(request, response);
    });
    http_.Get("/favicon.ico",
              [](const httplib::Request&, httplib::Response& response) { response.status = 204; });
  }

  void bind() {
    int port = params_.at.port;
    errno = 0;
    bool isBound = port != 0 && http_.bind_to_port(params_.at.host, port);
    if (port == 0 || (!isBound && !params_.isPortFixed)) {
      port = http_.bind_to_any_port(params_.at.host);
      isBound = port > 0;
    }
    if (!isBound) {
      const std::string reason = errno != 0 ? std::string(" (") + std::strerror(errno) + ')' : "";
      throw std::runtime_error("cannot listen at " + params_.at.toString() + reason +
                               "; port 0 takes any that is free");
    }
    params_.at.port = port;
  }

  static void refuse(httplib::Response& response, int status, const char* why) {
    response.status = status;
    response.set_content(why, "text/plain; charset=utf-8");
  }

  void noteRequest() { lastRequest_ = clock_.seconds(); }

  void image(const httplib::Request& request, httplib::Response& response) {
    feed_.want(kWanted);
    noteRequest();
    const bool isLast = feed_.isClosed();
    const std::shared_ptr<const Snapshot> snapshot = feed_.latest();
    if (!snapshot || std::to_string(snapshot->sequence) == request.get_param_value("after")) {
      response.status = 204;
      if (isLast) lastImageServed_ = true;
      return;
    }
    const std::string header = imageHeader(*snapshot);
    const auto* const floats = reinterpret_cast<const char*>(snapshot->image.data().data());
    const std::size_t size = header.size() + snapshot->image.data().size() * sizeof(float);
    response.set_content_provider(
        size, "application/octet-stream",
        [this, snapshot, header, floats, size](std::size_t offset, std::size_t length,
                                               httplib::DataSink& sink) {
          const bool inHeader = offset < header.size();
          const char* const from = inHeader ? header.data() + offset : floats + (offset - header.size());
          const std::size_t end = inHeader ? header.size() : size;
          return !isEnding_ && sink.write(from, std::min({length, kChunk, end - offset}));
        },
        [this, isLast](bool isComplete) {
          noteRequest();
          if (isLast && isComplete) lastImageServed_ = true;
        });
  }

  void stop(const httplib::Request& request, httplib::Response& response) {
    noteRequest();
    if (!isSame(request.body, token_)) {
      return refuse(response, 403, "the body must be the token that was printed when the render started\n");
    }
    stop_();
    response.set_content("the render stops, and the image so far is written\n", "text/plain; charset=utf-8");
  }

  void sayFarewell() {
    const Stopwatch farewell;
    const auto isLookedAt = [this] { return clock_.seconds() - lastRequest_ < kWatching; };
    while (isLookedAt() && !(lastStatusServed_ && lastImageServed_) &&
           farewell.seconds() < params_.farewellSeconds) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  Feed& feed_;
  Params params_;
  std::function<void()> stop_;
  std::string token_;
  httplib::Server http_;
  Stopwatch clock_;
  std::atomic<double> lastRequest_{-kWatching};
  std::atomic<bool> lastStatusServed_{false}, lastImageServed_{false}, isEnding_{false}, isOver_{false};
  std::thread thread_;
};

bool PageServer::isAvailable() { return true; }

PageServer::PageServer(Feed& feed, const Params& params, std::function<void()> stop)
    : server_(std::make_unique<Server>(feed, params, std::move(stop))) {}

const Endpoint& PageServer::at() const { return server_->at(); }
const std::string& PageServer::token() const { return server_->token(); }

}  // namespace pbrtmedia

#else  // without the library

namespace pbrtmedia {

class PageServer::Server {
 public:
  Endpoint at;
  std::string token;
};

bool PageServer::isAvailable() { return false; }

PageServer::PageServer(Feed&, const Params&, std::function<void()>) {
  throw std::runtime_error(
      "this pbrt was built without cpp-httplib and serves no page; install libcpp-httplib-dev and build "
      "again");
}

const Endpoint& PageServer::at() const { return server_->at; }
const std::string& PageServer::token() const { return server_->token; }

}  // namespace pbrtmedia

#endif

namespace pbrtmedia {

PageServer::~PageServer() = default;

std::string PageServer::url() const {
  Endpoint shown = at();
  if (shown.host == "0.0.0.0") shown.host = "127.0.0.1";
  if (shown.host == "::") shown.host = "::1";
  return "http://" + shown.toString() + "/#" + token();
}

}  // namespace pbrtmedia
