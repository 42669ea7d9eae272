// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "embedded_file.h"
#include "net/access/access_tokens.h"
#include "net/http/http_response.h"
#include "projects/http_head.h"
#include "projects/projects.h"

namespace raybundle {

/// Files of client_web that the front serves.
std::span<const EmbeddedFile> project_files();

/// What the front answers by itself: the list of projects, its figures, and why a project cannot be
/// visited. Answers are whole, from the status line on.
class FrontPages {
  public:
    explicit FrontPages(const Projects& projects) : projects_(projects) {}

    void set_tokens(AccessTokens tokens) { tokens_ = std::move(tokens); }
    void note_connections(std::size_t count) { connections_ = count; }

    /// Of a request that leads to no project.
    [[nodiscard]] std::string answer(const RequestHead& request, FrontTime now) const;
    /// A probe or a collector of figures asks for a project whose server does not run: it is not
    /// woken for that. Empty: the request is for the server.
    [[nodiscard]] static std::string answer_asleep(const RequestHead& request,
                                                   std::string_view target);
    /// A request that is refused: a page for browsers, which ask again by themselves where that may
    /// help, else application/problem+json.
    [[nodiscard]] static std::string refuse(const RequestHead& request, int status,
                                            const std::string& text);
    /// To a project's name without a slash.
    [[nodiscard]] static std::string redirect(const RequestHead& request,
                                              const std::string& location);

  private:
    [[nodiscard]] HttpResponse response(const RequestHead& request, FrontTime now) const;
    [[nodiscard]] HttpResponse picture(std::string_view file, bool trusted) const;

    const Projects& projects_;
    AccessTokens tokens_;
    std::size_t connections_ = 0;
};

}  // namespace raybundle
