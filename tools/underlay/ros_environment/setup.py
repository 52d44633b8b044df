# SPDX-License-Identifier: Apache-2.0
"""Install the environment hooks, the DDS profile and the Python module."""

from glob import glob

from setuptools import find_packages, setup

package_name = 'ros_environment'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/config', glob('config/*')),
        ('share/' + package_name + '/hook', glob('hook/*')),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Sets the environment of ROS 2 Jazzy in a virtual environment',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'setuptools.finalize_distribution_options': [
            'missing_data_files = ros_environment.missing_data_files:leave_out',
        ],
    },
)
