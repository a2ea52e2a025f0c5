// The exported module in MaterialX's WebAssembly build: `node web.mjs BIN CATSEYE.mjs DOCUMENT.mtlx` prints the pixel shader.
// BIN is the folder `bin` of the npm package @needle-tools/materialx.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [bin, module, path] = process.argv.slice(2);
const bytes = (name) => new Uint8Array(readFileSync(`${bin}/${name}`)).buffer;
// What the build expects of CommonJS.
globalThis.require = createRequire(import.meta.url);
globalThis.__dirname = bin;

const { default: MaterialX } = await import(pathToFileURL(`${bin}/JsMaterialXGenShader.js`));
const { addCatseye } = await import(pathToFileURL(module));
const mx = await MaterialX({
  wasmBinary: bytes("JsMaterialXGenShader.wasm"),
  getPreloadedPackage: () => bytes("JsMaterialXGenShader.data.txt"),
  locateFile: (name) => name,
});
const generator = mx.EsslShaderGenerator.create();
const context = new mx.GenContext(generator);
const library = mx.loadStandardLibraries(context);
if (process.argv[5] !== "without") {
  await addCatseye(mx, library);
}
const document = mx.createDocument();
await mx.readFromXmlString(document, readFileSync(path, "utf8"), "");
document.setDataLibrary(library);
try {
  const shader = generator.generate("material", mx.findRenderableElement(document), context);
  process.stdout.write(shader.getSourceCode("pixel"));
} catch (error) {
  process.stderr.write(typeof error === "number" ? mx.getExceptionMessage(error) : String(error));
  process.exitCode = 1;
}
