# SPDX-License-Identifier: Apache-2.0
"""Plots of numeric message fields: paths, values, decimation and legend; without ROS."""
