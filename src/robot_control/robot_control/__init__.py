# SPDX-License-Identifier: Apache-2.0
"""A node that reads a robot model of another package and reports what it loaded."""
