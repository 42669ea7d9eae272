# SPDX-License-Identifier: Apache-2.0
"""Generator of the shipped scenes. Lengths in metres, Y up, right-handed, as in glTF."""
