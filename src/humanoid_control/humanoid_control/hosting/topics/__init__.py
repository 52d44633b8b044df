# SPDX-License-Identifier: Apache-2.0
"""Topics of one robot, each as a thin class around a preallocated message."""
