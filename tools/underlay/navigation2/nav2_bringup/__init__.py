# SPDX-License-Identifier: Apache-2.0
"""Launch files that start navigation, and their shared functions."""
