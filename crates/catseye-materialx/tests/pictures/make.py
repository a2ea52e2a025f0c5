"""Makes the pictures of this folder with programs that the reader shares no code with.

pip install pillow numpy OpenEXR tifffile imagecodecs opencv-python-headless; python make.py
Pixel (x, y) of 9 x 3 has 20 x + 9 y + 20 c in channel c, of 255.
"""

import struct

import cv2
import numpy
import OpenEXR
import tifffile
from PIL import Image

y, x, c = numpy.mgrid[0:3, 0:9, 0:4]
bytes4 = (20 * x + 9 * y + 20 * c).astype(numpy.uint8)
bytes3, grey = bytes4[..., :3], bytes4[..., 0]
words4 = bytes4.astype(numpy.uint16) * 257
floats4 = bytes4.astype(numpy.float32) / 255
halves4 = floats4.astype(numpy.float16)

Image.fromarray(bytes3).save("rgb8.png")
Image.fromarray(grey).convert("P").save("palette.png")
cv2.imwrite("rgba16.png", words4[..., [2, 1, 0, 3]])
cv2.imwrite("grey16.png", words4[..., 0])
# Baseline with all pixels, then what cameras and the web have: subsampled, progressive.
Image.fromarray(bytes3).save("rgb.jpg", quality=100, subsampling=0)
Image.fromarray(grey).save("grey.jpg", quality=100)
Image.fromarray(bytes3).save("progressive.jpg", quality=100, subsampling=2, progressive=True)
Image.fromarray(grey).convert("P").save("grey.gif")
Image.fromarray(bytes3).save("rgb.bmp")
Image.fromarray(grey).save("palette.bmp")
Image.fromarray(grey > 100).save("bits.bmp")
Image.fromarray(bytes4).save("rgba.bmp")
Image.fromarray(bytes3).save("rgb.tga")
Image.fromarray(bytes4).save("rgba_runs.tga", compression="tga_rle")
Image.fromarray(grey).save("grey.tga")
Image.fromarray(grey).convert("P").save("palette_runs.tga", compression="tga_rle")
cv2.imwrite("rgb.hdr", floats4[..., [2, 1, 0]])


def bmp(name, bits, compression, palette, pixels):
    """What Pillow doesn't write."""
    start = 54 + len(palette)
    info = struct.pack("<IiiHHIIiiII", 40, 9, 3, 1, bits, compression, len(pixels), 0, 0, 0, 0)
    head = struct.pack("<2sIHHI", b"BM", start + len(pixels), 0, 0, start)
    open(name, "wb").write(head + info + palette + pixels)


masks = struct.pack("<III", 31 << 11, 63 << 5, 31)
five_six_five = [((r >> 3) << 11) | ((g >> 2) << 5) | (b >> 3) for r, g, b in bytes3[::-1].reshape(-1, 3).astype(int)]
rows = [struct.pack("<10H", *five_six_five[9 * i : 9 * i + 9], 0) for i in range(3)]
bmp("565.bmp", 16, 3, masks, b"".join(rows))
greys = b"".join(bytes([i, i, i, 0]) for i in range(256))
runs = b"".join(bytes([0, 9, *row, 0, 0, 0]) for row in grey[::-1])
bmp("runs.bmp", 8, 1, greys, runs + b"\0\1")

def exr(name, channels, **header):
    header = {"type": OpenEXR.scanlineimage, **header}
    OpenEXR.File(header, {key: numpy.ascontiguousarray(value) for key, value in channels.items()}).write(name)


exr("rgb_half.exr", {"RGB": halves4[..., :3]}, compression=OpenEXR.ZIP_COMPRESSION)
exr("rgba_float.exr", {"RGBA": floats4}, compression=OpenEXR.PIZ_COMPRESSION)
exr("height.exr", {"height": floats4[..., 0]}, compression=OpenEXR.NO_COMPRESSION)
exr("layers.exr", {"normal.R": halves4[..., 0], "normal.G": halves4[..., 1], "normal.B": halves4[..., 2]},
    compression=OpenEXR.ZIPS_COMPRESSION)

tifffile.imwrite("rgb8_lzw.tif", bytes3, photometric="rgb", compression="lzw")
tifffile.imwrite("grey16_zip.tif", words4[..., 0], photometric="minisblack", compression="zlib", predictor=True)
tifffile.imwrite("rgba_half_planes.tif", numpy.moveaxis(halves4, 2, 0), photometric="rgb", planarconfig="separate",
                 extrasamples=["unassalpha"], rowsperstrip=2)
tifffile.imwrite("rgb_float_tiles.tif", floats4[..., :3], photometric="rgb", tile=(16, 16), byteorder=">", bigtiff=True)
