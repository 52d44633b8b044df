# SPDX-License-Identifier: Apache-2.0
"""The planner server, and the shared search algorithms of its planners."""
