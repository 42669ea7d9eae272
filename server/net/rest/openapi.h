// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace raybundle {

/// OpenAPI 3.1 description of rest_routes(), with schemas of raybundle.proto; made once.
std::shared_ptr<const std::string> openapi_document();

}  // namespace raybundle
