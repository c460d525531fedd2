declare module 'virtual:clips' {
  const clips: readonly { readonly name: string; readonly about: string }[];
  export default clips;
}
