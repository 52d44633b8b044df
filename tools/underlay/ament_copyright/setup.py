# SPDX-License-Identifier: Apache-2.0
"""Install the checker and its command."""

from setuptools import find_packages, setup

package_name = 'ament_copyright'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='The check that source files name their copyright and licence',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': ['ament_copyright = ament_copyright.main:main'],
        'pytest11': ['ament_copyright = ament_copyright.pytest_marker'],
    },
)
