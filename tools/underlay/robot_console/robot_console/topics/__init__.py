# SPDX-License-Identifier: Apache-2.0
"""The topics of a robot: how often they come, and what they say."""
