# SPDX-License-Identifier: Apache-2.0
"""Publish where the links of a robot are, from its URDF and its joint states."""
