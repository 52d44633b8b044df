# SPDX-License-Identifier: Apache-2.0
"""The displays of RViz."""
