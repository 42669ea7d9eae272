// SPDX-License-Identifier: Apache-2.0
// Base colour of patches, and the reflectance record (bits) of glossy ones or NOT_GLOSSY.
layout(binding = UNIT_REFLECTORS) uniform usamplerBuffer reflector_texels;

bool is_glossy(uint patch_id) { return texelFetch(reflector_texels, int(patch_id)).w != NOT_GLOSSY; }
