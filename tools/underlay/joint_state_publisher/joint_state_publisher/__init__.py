# SPDX-License-Identifier: Apache-2.0
"""Publish the joint states of a robot: default values merged with those of source topics."""
