/** Pictures of questions: files of the story's folder. */

/** The address of a file in the folder of a story. Whatever its name holds, it is a name: it leads to no other folder. */
export function addressOf(file: string, story: URL): string {
  const steps = file.split('/').filter((step) => step !== '..');
  return new URL(`./${steps.map(encodeURIComponent).join('/')}`, story).href;
}
