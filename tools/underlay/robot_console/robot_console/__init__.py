# SPDX-License-Identifier: Apache-2.0
"""A console for robots: panels for RViz in the browser."""
