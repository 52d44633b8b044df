# SPDX-License-Identifier: Apache-2.0
"""Draw the frames of tf."""
