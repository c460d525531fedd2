/** Types of the parts of the package that are used; the package has none. */
declare module 'gltf-validator' {
  interface Message {
    readonly code: string;
    readonly message: string;
    /** 0 error, 1 warning, 2 information, 3 hint. */
    readonly severity: 0 | 1 | 2 | 3;
    readonly pointer?: string;
  }
  interface Report {
    readonly issues: { readonly messages: readonly Message[]; readonly truncated: boolean };
    readonly info: { readonly totalTriangleCount: number; readonly drawCallCount: number };
  }
  export function validateBytes(bytes: Uint8Array, options?: { uri?: string; maxIssues?: number }): Promise<Report>;
}
