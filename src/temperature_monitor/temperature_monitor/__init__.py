# SPDX-License-Identifier: Apache-2.0
"""A thermometer that makes its readings up, and a node that warns when it is hot."""
