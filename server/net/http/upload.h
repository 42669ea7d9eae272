// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace raybundle {

/// How an upload has ended: an HTTP status and a line of text for the client.
struct UploadResult {
    int status = 201;
    std::string text;
};

/// A scene or photometric file on its way in. Nothing of it stays where it is dropped before it is
/// finished.
class Upload {
  public:
    virtual ~Upload() = default;

    /// The next bytes. False: they cannot be stored.
    virtual bool write(std::string_view bytes) = 0;

    /// All bytes have come: checks the file and puts it in its place, on another thread. `done` is
    /// called once, on any thread, unless the program ends before.
    virtual void finish(std::function<void(UploadResult)> done) = 0;
};

/// Begins an upload under a valid name of a scene or photometric file, or says with null that it
/// cannot be stored.
using UploadFactory = std::function<std::unique_ptr<Upload>(const std::string& name)>;

}  // namespace raybundle
