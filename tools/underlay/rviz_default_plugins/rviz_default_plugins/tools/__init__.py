# SPDX-License-Identifier: Apache-2.0
"""Tools: what the pointer does in the scene."""
