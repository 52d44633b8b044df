# SPDX-License-Identifier: Apache-2.0
"""RViz in the browser."""
