// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "display/endpoint.h"
#include "display/feed.h"

namespace pbrtmedia {

/// Serves one page that shows a render to browsers, on threads of its own:
///
///   GET /                the page
///   GET /status          statusText
///   GET /image?after=N   imageHeader and the floats of the latest image; 204 when its sequence is N: no
///   newer one POST /stop           ends the render, if the body is the token; 403 else
///
/// Requests that do not name this server are refused (host_header.h), and the page may load nothing from
/// elsewhere. Requests are what makes images wanted, so that a render which nobody looks at makes none.
class PageServer {
 public:
  struct Params {
    Endpoint at{"127.0.0.1", kPagePort};
    bool isPortFixed = true;  ///< else another one is taken when that is not free
    double farewellSeconds = 3;
  };

  /// False where the program was built without the library for it; the constructor throws then.
  static bool isAvailable();
  /// `stop` is called on a thread of the server, perhaps more than once. Throws std::runtime_error when it
  /// cannot listen there. `feed` must outlive the object.
  PageServer(Feed& feed, const Params& params, std::function<void()> stop);
  /// The feed must be closed: a browser that was looking a moment ago gets the last status and image, but no
  /// longer than Params::farewellSeconds are waited for it.
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  const Endpoint& at() const;        ///< with the port that it has
  const std::string& token() const;  ///< 32 hexadecimal digits, others each time
  /// To be opened in a browser: with the token behind '#', which browsers keep to themselves.
  std::string url() const;

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace pbrtmedia
