# SPDX-License-Identifier: Apache-2.0
"""The topics of one robot, each as a thin class around messages that are used again."""
