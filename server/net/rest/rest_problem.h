// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "net/http/http_response.h"
#include "raybundle.pb.h"

namespace raybundle {

/// HTTP status of an error of the protocol.
int http_status(v1::Error::Code code);

/// An error as application/problem+json (RFC 9457): v1::Problem. code: of the protocol, where it is
/// one of these.
HttpResponse problem(int status, std::string detail,
                     v1::Error::Code code = v1::Error::CODE_UNSPECIFIED);
HttpResponse problem(v1::Error::Code code, std::string detail);

}  // namespace raybundle
