# SPDX-License-Identifier: Apache-2.0
"""Publish the positions of the joints of a robot: defaults, merged with other sources."""
