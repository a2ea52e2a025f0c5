// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The Catseye library for MaterialX's WebAssembly module, in one file that needs nothing else.
//
//   import { addCatseye } from "./catseye.mjs";
//   const library = mx.loadStandardLibraries(context);
//   await addCatseye(mx, library);
//   document.setDataLibrary(library);

/** The library's files, from the folder `libraries` on. */
export const FILES = {};

/** Adds the nodes to a data library, and their code to the file system in memory, under the folder that MaterialX's own is in. */
export async function addCatseye(mx, library, root = "/libraries") {
  for (const [path, text] of Object.entries(FILES)) {
    const full = `${root}/${path}`;
    if (path.endsWith(".mtlx")) {
      const document = mx.createDocument();
      await mx.readFromXmlString(document, text, "");
      // Implementations look for their code beside the document.
      document.setSourceUri(full);
      library.importLibrary(document);
    } else {
      const slash = full.lastIndexOf("/");
      mx.FS_createPath("/", full.slice(1, slash), true, true);
      mx.FS_createDataFile(full.slice(0, slash), full.slice(slash + 1), text, true, true);
    }
  }
}
