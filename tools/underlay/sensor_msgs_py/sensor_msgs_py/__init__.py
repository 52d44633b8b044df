# SPDX-License-Identifier: Apache-2.0
"""Messages of sensor_msgs in Python: see the module `point_cloud2`."""
