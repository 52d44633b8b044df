# SPDX-License-Identifier: Apache-2.0
"""The server that plans global paths, and what its planners have in common."""
