# SPDX-License-Identifier: Apache-2.0
"""The displays and tools of RViz."""
