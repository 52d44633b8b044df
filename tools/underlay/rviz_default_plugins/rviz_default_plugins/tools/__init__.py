# SPDX-License-Identifier: Apache-2.0
"""The tools for the pointer in the scene."""
