# SPDX-License-Identifier: Apache-2.0
"""The bridge between messages with images and arrays of OpenCV."""

from __future__ import annotations

from array import array
from typing import Any

from cv_bridge.conversion import convert, CvBridgeError, encoding_of, opencv
from image_transport.encodings import Encoding, Pixels, view_pixels
import numpy as np
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

__all__ = ['CvBridge', 'CvBridgeError']

_KINDS = {
    '8U': 'uint8',
    '8S': 'int8',
    '16U': 'uint16',
    '16S': 'int16',
    '32S': 'int32',
    '32F': 'float32',
    '64F': 'float64',
}
_DECODED = {
    ('u1', 1): 'mono8',
    ('u1', 3): 'bgr8',
    ('u1', 4): 'bgra8',
    ('u2', 1): 'mono16',
    ('u2', 3): 'bgr16',
    ('u2', 4): 'bgra16',
}


class CvBridge:
    """Converts images between messages of ROS and arrays, as OpenCV uses them."""

    def imgmsg_to_cv2(self, img_msg: Image, desired_encoding: str = 'passthrough') -> Pixels:
        """
        Convert an image message to an array.

        Colours, greys, Bayer patterns and YUV are converted into colours and greys, and 8 bits
        into 16 and back with a change of scale. Numbers without a meaning as colours, such as
        those of `16UC1`, only change their type, and only if they have as many channels.

        Parameters
        ----------
        img_msg
            The message.
        desired_encoding
            The encoding of the result, such as 'bgr8', 'mono8' or '32FC1'; 'passthrough' for that
            of the message, in which case the array shares the memory of the message.

        Returns
        -------
        Pixels
            The image (height, width) if it has one channel, otherwise (height, width, channels).

        Raises
        ------
        CvBridgeError
            An encoding is unknown, there is no such conversion, or the image is broken.

        """
        source = encoding_of(img_msg.encoding)
        try:
            pixels = view_pixels(img_msg, source)
        except ValueError as error:
            raise CvBridgeError(str(error)) from None
        pixels = pixels.astype(pixels.dtype.newbyteorder('='), copy=False)
        if desired_encoding == 'passthrough':
            return pixels
        converted = convert(pixels, img_msg.encoding, desired_encoding)
        return pixels.copy() if converted is pixels else converted

    def cv2_to_imgmsg(
        self, cvim: Pixels, encoding: str = 'passthrough', header: Header | None = None
    ) -> Image:
        """
        Convert an array to an image message; its values stay as they are.

        Parameters
        ----------
        cvim
            The image (height, width) or (height, width, channels).
        encoding
            The encoding of the array, such as 'bgr8'; 'passthrough' for the name of its type, such
            as '8UC3'.
        header
            The header of the message; empty by default.

        Returns
        -------
        Image
            The message.

        Raises
        ------
        CvBridgeError
            The encoding is unknown, or another one than that of an array of this type.
        TypeError
            The image is not an array of NumPy.

        """
        type_name = self._type_name(cvim)
        if encoding == 'passthrough':
            encoding = type_name
        elif (expected := encoding_of(encoding).type_name) != type_name:
            raise CvBridgeError(
                f"An image of the encoding '{encoding}' is an array of {expected}, but this one "
                f'is of {type_name}: convert the array first, or name its own encoding.'
            )
        height, width = cvim.shape[:2]
        return Image(
            header=header or Header(),
            height=height,
            width=width,
            encoding=encoding,
            is_bigendian=np.dtype(cvim.dtype).newbyteorder('>') == cvim.dtype
            and cvim.itemsize > 1,
            step=cvim.nbytes // height if height else 0,
            data=_bytes(cvim),
        )

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: CompressedImage, desired_encoding: str = 'passthrough'
    ) -> Pixels:
        """
        Decompress an image message to an array.

        Parameters
        ----------
        cmprs_img_msg
            The message with a JPEG, a PNG or another file that OpenCV reads.
        desired_encoding
            The encoding of the result; 'passthrough' for what is in the file, with colours in the
            order blue, green, red.

        Returns
        -------
        Pixels
            The image (height, width) or (height, width, channels).

        Raises
        ------
        CvBridgeError
            The data are no such file, or there is no conversion to the encoding.
        ImportError
            OpenCV is not installed.

        """
        cv2 = opencv('decompresses images')
        data = np.frombuffer(cmprs_img_msg.data, np.uint8)
        try:
            read: Any = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if data.size else None
        except cv2.error:
            read = None
        if read is None:
            raise CvBridgeError(
                f"The {data.size} bytes of data with the format '{cmprs_img_msg.format}' are no "
                f'file that OpenCV can read.{_advice(cmprs_img_msg.format)}'
            )
        pixels: Pixels = read
        if desired_encoding == 'passthrough':
            return pixels
        found = (pixels.dtype.str[1:], 1 if pixels.ndim == 2 else pixels.shape[2])
        return convert(pixels, _DECODED.get(found) or self._type_name(pixels), desired_encoding)

    def cv2_to_compressed_imgmsg(
        self, cvim: Pixels, dst_format: str = 'jpg', header: Header | None = None
    ) -> CompressedImage:
        """
        Compress an array to an image message.

        Parameters
        ----------
        cvim
            The image (height, width), or (height, width, channels) in the order blue, green, red
            and, if the format has it, alpha.
        dst_format
            The format as the ending of a file that OpenCV writes: 'jpg', 'png', 'bmp' ...
        header
            The header of the message; empty by default.

        Returns
        -------
        CompressedImage
            The message.

        Raises
        ------
        CvBridgeError
            OpenCV cannot write such an image in this format.
        ImportError
            OpenCV is not installed.
        TypeError
            The image is not an array of NumPy.

        """
        type_name = self._type_name(cvim)
        cv2 = opencv('compresses images')
        try:
            worked, data = cv2.imencode(f'.{dst_format}', cvim)
        except cv2.error:
            worked = False
        if not worked:
            raise CvBridgeError(
                f"OpenCV cannot write an image of {type_name} as '{dst_format}': formats are jpg, "
                'png, bmp, webp, tiff ..., and jpg takes 8UC1 and 8UC3.'
            )
        return CompressedImage(header=header or Header(), format=dst_format, data=_bytes(data))

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """
        Return the type of the arrays of an encoding.

        Parameters
        ----------
        encoding
            Such as 'bgr8'.

        Returns
        -------
        tuple
            The name of the type of NumPy and the number of channels, such as ('uint8', 3).

        Raises
        ------
        CvBridgeError
            The encoding is unknown.

        """
        found = encoding_of(encoding)
        return np.dtype(found.kind).name, found.channels

    def dtype_with_channels_to_cvtype2(self, dtype: Any, n_channels: int) -> str:
        """
        Return the name of the OpenCV type of an array.

        Parameters
        ----------
        dtype
            The type of NumPy.
        n_channels
            The number of channels.

        Returns
        -------
        str
            Such as '8UC3'.

        Raises
        ------
        CvBridgeError
            OpenCV has no such type.

        """
        for letters, name in _KINDS.items():
            if name == np.dtype(dtype).name:
                return f'{letters}C{n_channels}'
        raise CvBridgeError(
            f'Images cannot have values of type {np.dtype(dtype)}: convert the array with astype '
            f'to {", ".join(_KINDS.values())}.'
        )

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """
        Return the type of NumPy of an OpenCV type.

        Parameters
        ----------
        cvtype
            The number of the type, such as `cv2.CV_8UC3`.

        Returns
        -------
        tuple
            The name of the type of NumPy and the number of channels, such as ('uint8', 3).

        Raises
        ------
        CvBridgeError
            It is no such number.
        ImportError
            OpenCV is not installed.

        """
        cv2 = opencv('numbers its types')
        channels, depth = divmod(cvtype, _step(cv2))
        for letters, name in _KINDS.items():
            if getattr(cv2, f'CV_{letters}') == depth and channels >= 0:
                return name, channels + 1
        raise CvBridgeError(f'{cvtype} is not an image type of OpenCV, such as cv2.CV_8UC3.')

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """
        Return the OpenCV type of an encoding.

        Parameters
        ----------
        encoding
            Such as 'bgr8'.

        Returns
        -------
        int
            The number of the type, such as `cv2.CV_8UC3`.

        Raises
        ------
        CvBridgeError
            The encoding is unknown.
        ImportError
            OpenCV is not installed.

        """
        found = encoding_of(encoding)
        cv2 = opencv('numbers its types')
        depth: int = getattr(cv2, f'CV_{_depth_name(found)}')
        return depth + (found.channels - 1) * _step(cv2)

    def _type_name(self, cvim: Any) -> str:
        if not isinstance(cvim, np.ndarray):
            raise TypeError(f'An image is an array of NumPy, not of the type {type(cvim)}.')
        if cvim.ndim not in (2, 3):
            raise CvBridgeError(
                'An image is an array (height, width) or (height, width, channels); this one has '
                f'the shape {cvim.shape}.'
            )
        channels = 1 if cvim.ndim == 2 else cvim.shape[2]
        return self.dtype_with_channels_to_cvtype2(cvim.dtype, channels)


def _step(cv2: Any) -> int:
    """Return by how much one more channel increases the number of a type; versions differ."""
    return int(cv2.CV_8UC2 - cv2.CV_8UC1)


def _depth_name(encoding: Encoding) -> str:
    return encoding.type_name.partition('C')[0]


def _bytes(pixels: Pixels) -> array[int]:
    """Return the memory of an array in the type that messages store without a check of each."""
    data = array('B')
    data.frombytes(np.ascontiguousarray(pixels).tobytes())
    return data


def _advice(form: str) -> str:
    if 'compressedDepth' in form:
        return (
            ' It is a compressed depth: `ros2 run image_transport republish` with in_transport '
            'compressedDepth and out_transport raw publishes images.'
        )
    return ''
