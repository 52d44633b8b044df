# SPDX-License-Identifier: Apache-2.0
"""Drive a robot with the keys of a terminal."""
