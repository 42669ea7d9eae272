# SPDX-License-Identifier: Apache-2.0
"""An office building of any number of floors, as files of any size."""
